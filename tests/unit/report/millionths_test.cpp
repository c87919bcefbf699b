// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "core/number.hpp"
#include "report/text/formatting.hpp"

namespace strake::report {
namespace {

/// What a text that append_mm() and its like wrote reads as, in whole millionths.
template <class Append>
double read_back(Append append, double value) {
  std::string text;
  append(text, value);
  return parse_number(text).value();
}

void expect_texts(double value) {
  EXPECT_EQ(static_cast<double>(millionths(value)) / 1e6, read_back(append_mm, value)) << value;
  EXPECT_EQ(static_cast<double>(millionths_floor(value)) / 1e6, read_back(append_mm_floor, value))
      << value;
  EXPECT_EQ(static_cast<double>(millionths_ceil(value)) / 1e6, read_back(append_mm_ceil, value))
      << value;
}

TEST(Millionths, AreWhatTheTextsReadAs) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> exponent(-9, 8), mantissa(-1, 1);
  for (int i = 0; i < 20'000; ++i) expect_texts(mantissa(random) * std::pow(10, exponent(random)));
  // Between two millionths, exactly and nearly.
  for (const double value :
       {0.0, -0.0, 0.5e-6, -0.5e-6, 1.5e-6, 2.5e-6, 0.0000005, 123.0000005,
        std::nextafter(0.5e-6, 1.0), 0.1, -0.3, 1e8 + 0.5e-6, 4503599627.3704955})
    expect_texts(value);
}

TEST(Millionths, OfWhatDoesNotFit) {
  EXPECT_EQ(millionths(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_GT(millionths(1e300), std::int64_t{9'000'000'000'000'000'000});
  EXPECT_LT(millionths(-std::numeric_limits<double>::infinity()),
            std::int64_t{-9'000'000'000'000'000'000});
}

}  // namespace
}  // namespace strake::report
