// SPDX-License-Identifier: Apache-2.0
#include "drawing/layout/view_title.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "strake/drawing/view.hpp"

namespace strake::drawing {
namespace {

using geometry::Vec3l;

constexpr std::int64_t kUnitsPerMm = 1000;  // grid units

TEST(ViewTitle, StatesTheSections) {
  const auto title = [](std::vector<hlr::Section> sections, Vec3l direction = {0, 0, 1}) {
    hlr::View view;
    view.direction = direction;
    view.sections = std::move(sections);
    return title_of("top", view);
  };
  const hlr::Section deck{{0, 0, 1}, {0, 0, 4'500 * kUnitsPerMm}};
  EXPECT_EQ(title({}), "top");
  EXPECT_EQ(title({deck}), "SECTION z = 4.5 m");
  EXPECT_EQ(title({deck}, {0, 0, -1}), "SECTION z = 4.5 m");
  EXPECT_EQ(title({deck}, {1, -1, 1}), "top, SECTION z = 4.5 m");
  EXPECT_EQ(title({deck, {{-1, 0, 0}, {350'125, 0, 0}}}), "top, SECTION z = 4.5 m, x = 350.125 mm");
  EXPECT_EQ(title({{{0, 0, -1}, {}}}), "SECTION z = 0 m");
  EXPECT_EQ(title({{{0, 0, 1}, {0, 0, -100'000'000 * kUnitsPerMm}}}), "SECTION z = -100000 m");
  // A plane across no axis, at a grid point beside its distance from the origin.
  const auto askew = parse_section("3,4,0>12500mm", {0, 0, 1});
  ASSERT_TRUE(askew);
  EXPECT_EQ(title({askew->section}, {3, 4, 0}), "SECTION 3,4,0 = 12.5 m");
  // The title says the plane as it was written, whichever side is cut away.
  const auto title_in = [&](const char* text) {
    const auto parsed = parse_section(text, {0, 0, 1});
    return parsed ? title({parsed->section}) : parsed.error().message;
  };
  EXPECT_EQ(title_in("1,2,0<4500mm"), "top, SECTION 1,2,0 = 4.5 m");
  EXPECT_EQ(title_in("0,1,-2<4500mm"), "top, SECTION 0,1,-2 = 4.5 m");
  EXPECT_EQ(title_in("1,2,0<-4500mm"), "top, SECTION 1,2,0 = -4.5 m");
  EXPECT_EQ(title_in("-1,2,0>4500mm"), "top, SECTION 1,-2,0 = -4.5 m");
  EXPECT_EQ(title_in("1,2,0<0mm"), "top, SECTION 1,2,0 = 0 m");
}

}  // namespace
}  // namespace strake::drawing
