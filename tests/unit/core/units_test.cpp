// SPDX-License-Identifier: Apache-2.0
#include "core/units.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace strake {
namespace {

TEST(Units, lengths) {
  struct Case {
    const char* text;
    double mm;
  };
  for (const Case& one :
       {Case{"25mm", 25}, Case{"0.5m", 500}, Case{" -1.5 cm ", -15}, Case{"1in", 25.4},
        Case{"2ft", 609.6}, Case{"3um", 0.003}, Case{"3µm", 0.003}, Case{"1e3m", 1e6}, Case{"0", 0},
        Case{"0.0", 0}, Case{"2 metres", 2000}, Case{"+7mm", 7}, Case{"12\"", 304.8},
        Case{"6'", 1828.8}}) {
    const Result<double> got = parse_length_mm(one.text);
    ASSERT_TRUE(got) << one.text << ": " << got.error().text();
    EXPECT_DOUBLE_EQ(*got, one.mm) << one.text;
  }
}

TEST(Units, a_bad_length_names_the_mend) {
  struct Case {
    const char* text;
    const char* mend;
  };
  for (const Case& one :
       {Case{"25", "write 25mm"}, Case{"", "as 25mm"}, Case{"mm", "as 25mm"},
        Case{"25 parsec", "um, mm, cm"}, Case{"nan", "as 25mm"}, Case{"inf mm", "as 25mm"},
        Case{"25mmm", "um, mm, cm"}, Case{"1e308km", "smaller"}, Case{"2,5mm", "write 2.5mm)"},
        Case{"-1,25", "write -1.25)"}, Case{"1,500mm", "write 1.500mm or 1500mm)"},
        Case{"1,2,3mm", "um, mm"}, Case{"abc", "'abc' is not a length"}, Case{"1em", "um, mm"},
        Case{"1e400", "too large"}, Case{"1e-400mm", "too small"},
        Case{"-5e-400mm", "too small"}}) {
    const Result<double> got = parse_length_mm(one.text);
    ASSERT_FALSE(got) << one.text;
    EXPECT_EQ(got.error().text().find("unit '0"), std::string::npos) << got.error().text();
    EXPECT_EQ(got.error().code, ErrorCode::usage);
    EXPECT_NE(got.error().text().find(one.mend), std::string::npos) << got.error().text();
  }
}

TEST(Units, distances_have_a_sign_and_an_end) {
  EXPECT_DOUBLE_EQ(*parse_distance_mm("25mm"), 25);
  EXPECT_DOUBLE_EQ(*parse_distance_mm("1km"), kLongestMm);
  EXPECT_DOUBLE_EQ(*parse_distance_mm("0"), 0);
  for (const auto& [text, words] :
       {std::pair{"-1mm", "'-1mm' is negative"}, std::pair{"-1", "'-1' is negative"},
        std::pair{"-1parsec", "unknown unit"}, std::pair{"1001m", "longer than a kilometre"},
        std::pair{"1e300mm", "longer than a kilometre"},
        std::pair{"25", "has no unit (write 25mm"}}) {
    const Result<double> got = parse_distance_mm(text);
    ASSERT_FALSE(got) << text;
    EXPECT_NE(got.error().text().find(words), std::string::npos) << got.error().text();
  }
}

TEST(Units, coordinates_are_millimetres_unless_they_state_otherwise) {
  EXPECT_DOUBLE_EQ(*parse_coordinate_mm("4500"), 4500);
  EXPECT_DOUBLE_EQ(*parse_coordinate_mm(" -4.5 m"), -4500);
  for (const auto& [text, words] :
       {std::pair{"4,5m", "write 4.5m"}, std::pair{"", "as 4.5m"}, std::pair{"nan", "as 4.5m"},
        std::pair{"4furlong", "unknown unit"}, std::pair{"1e400", "too large"}}) {
    const Result<double> got = parse_coordinate_mm(text);
    ASSERT_FALSE(got) << text;
    EXPECT_NE(got.error().text().find(words), std::string::npos) << got.error().text();
  }
}

TEST(Units, unit_names) {
  EXPECT_EQ(unit_mm("m"), 1000.0);
  EXPECT_EQ(unit_mm("millimetres"), 1.0);
  EXPECT_FALSE(unit_mm("ms"));
  EXPECT_FALSE(unit_mm(""));
  EXPECT_FALSE(unit_mm("M"));
  ASSERT_FALSE(parse_unit_mm("furlong"));
  EXPECT_NE(parse_unit_mm("furlong").error().text().find("um, mm"), std::string::npos);
}

TEST(Units, volumes) {
  for (const auto& [text, mm3] :
       {std::pair{"5cm3", 5e3}, std::pair{"5 cm³", 5e3}, std::pair{"7mm3", 7.0},
        std::pair{"2dm3", 2e6}, std::pair{"2l", 2e6}, std::pair{"0.5 litres", 5e5},
        std::pair{"1m3", 1e9}, std::pair{"1in3", 16387.064}, std::pair{"1ft3", 28316846.592},
        std::pair{"0", 0.0}}) {
    const Result<double> got = parse_volume_mm3(text);
    ASSERT_TRUE(got) << text << ": " << got.error().text();
    EXPECT_DOUBLE_EQ(*got, mm3) << text;
  }
  for (const auto& [text, words] :
       {std::pair{"5", "has no unit (write 5cm3"}, std::pair{"-5cm3", "'-5cm3' is negative"},
        std::pair{"5mm", "is a length, not a volume"}, std::pair{"5 gallons", "unknown unit"},
        std::pair{"1,5l", "write 1.5l)"}, std::pair{"", "is not a volume"},
        std::pair{"nan cm3", "is not a volume"}, std::pair{"1e308m3", "too large"}}) {
    const Result<double> got = parse_volume_mm3(text);
    ASSERT_FALSE(got) << text;
    EXPECT_NE(got.error().text().find(words), std::string::npos) << got.error().text();
  }
}

TEST(Units, angles) {
  EXPECT_DOUBLE_EQ(*parse_angle_deg("20deg"), 20);
  EXPECT_DOUBLE_EQ(*parse_angle_deg("20"), 20);
  EXPECT_DOUBLE_EQ(*parse_angle_deg("20°"), 20);
  EXPECT_DOUBLE_EQ(*parse_angle_deg("3.141592653589793 rad"), 180);
  EXPECT_FALSE(parse_angle_deg("20mm"));
  EXPECT_NE(parse_angle_deg("22,5deg").error().mend.find("22.5deg"), std::string::npos);
  EXPECT_FALSE(parse_angle_deg("steep"));
}

TEST(Units, scales) {
  EXPECT_EQ(parse_scale("100").error().text(), "'100' is not a scale (write 1:100)");
  EXPECT_EQ(parse_scale("big").error().text(),
            "'big' is not a scale (write paper to model, as 1:50)");
  EXPECT_DOUBLE_EQ(*parse_scale("1:50"), 50);
  EXPECT_DOUBLE_EQ(*parse_scale("2:1"), 0.5);
  EXPECT_DOUBLE_EQ(*parse_scale(" 1 : 7.5 "), 7.5);
  for (const char* const bad : {"50", "1/50", "0:1", "1:0", "1:-5", "1:", ":", "1e308:1e-308",
                                "1:5e-324", "1:1e300", "1e300:1", "1000001:1"}) {
    const Result<double> got = parse_scale(bad);
    ASSERT_FALSE(got) << bad;
    EXPECT_NE(got.error().text().find("1:"), std::string::npos);
  }
}

}  // namespace
}  // namespace strake
