// SPDX-License-Identifier: Apache-2.0
#include "core/number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace strake {
namespace {

TEST(Number, shortest_reads_back_bit_by_bit) {
  constexpr unsigned kSeed = 7;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value) || value == 0) continue;
    const auto back = parse_number(shortest(value));
    ASSERT_TRUE(back) << shortest(value);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(*back), std::bit_cast<std::uint64_t>(value));
  }
}

TEST(Number, shortest_text) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(-2.5), "-2.5");
  EXPECT_EQ(shortest(0.0), "0");
  EXPECT_EQ(shortest(-0.0), "0");
  EXPECT_EQ(shortest(1e30), "1e+30");
  EXPECT_EQ(shortest(-std::nan("")), "nan");
  EXPECT_EQ(shortest(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(Number, fixed_text) {
  EXPECT_EQ(fixed(1.005, 2), "1.00") << "1.005 is a little less than it looks";
  EXPECT_EQ(fixed(2.5, 0), "2");
  EXPECT_EQ(fixed(-0.004, 2), "0.00");
  EXPECT_EQ(fixed(-0.006, 2), "-0.01");
  EXPECT_EQ(fixed(-0.0, 3), "0.000");
  EXPECT_EQ(fixed(1e300, 1).size(), 303U);
  EXPECT_EQ(fixed(-std::numeric_limits<double>::max(), 17).size(), 1U + 309U + 1U + 17U);
  EXPECT_EQ(fixed(std::numeric_limits<double>::infinity(), 2), "inf");
}

TEST(Number, text_does_not_depend_on_the_locale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // absent on a bare machine: then nothing changes
  EXPECT_EQ(shortest(1234.5), "1234.5");
  EXPECT_EQ(fixed(1234.5, 1), "1234.5");
  EXPECT_EQ(parse_number("1234.5"), 1234.5);
  EXPECT_FALSE(parse_number("1234,5"));
  std::setlocale(LC_NUMERIC, before.c_str());
}

TEST(Number, parsing_takes_the_whole_text_or_nothing) {
  EXPECT_EQ(parse_number("+1.5e3"), 1500.0);
  EXPECT_EQ(parse_number("-.5"), -0.5);
  for (const char* const bad :
       {"", "+", "-", "1 ", " 1", "1x", "0x10", "nan", "inf", "1e999", "--1", "+-1", "1e", "."})
    EXPECT_FALSE(parse_number(bad)) << bad;
  EXPECT_EQ(parse_integer("-42"), -42);
  EXPECT_EQ(parse_integer("+42"), 42);
  for (const char* const bad : {"", "4.0", "1e3", "99999999999999999999", "4 ", "+-4"})
    EXPECT_FALSE(parse_integer(bad)) << bad;
}

}  // namespace
}  // namespace strake
