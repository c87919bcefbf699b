// SPDX-License-Identifier: Apache-2.0
#include "io/source/text_number.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

namespace strake::io {
namespace {

double number(const std::string& text) {
  const char* at = text.data();
  double value = 0;
  DigitStatistics digits;
  EXPECT_TRUE(read_number(at, text.data() + text.size(), value, digits)) << text;
  EXPECT_EQ(at, text.data() + text.size()) << text;
  return value;
}

TEST(TextNumber, EqualsStrtodOnSeededNumbers) {
  const unsigned seed = 20241;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  for (int i = 0; i < 200000; ++i) {
    std::string text = random() % 3 == 0 ? "-" : "";
    const auto digits = [&](std::uint64_t count) {
      for (std::uint64_t k = 0; k < count; ++k) text += static_cast<char>('0' + random() % 10);
    };
    digits(1 + random() % 20);
    if (random() % 4 != 0) {
      text += '.';
      digits(random() % 22);
    }
    if (random() % 4 == 0) text += fmt::format("e{}", static_cast<int>(random() % 700) - 350);
    ASSERT_EQ(number(text), std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(TextNumber, EqualsStrtodOnHalfwayCases) {
  // One ulp of a double apart, and exactly between, where a second rounding would show.
  for (const char* text :
       {"9007199254740993", "9007199254740992.5", "1.00000000000000011102230246251565",
        "2.2250738585072011e-308", "4.9406564584124654e-324", "2.4703282292062327e-324",
        "1.7976931348623158e308", "0.000000000000000000000000000001e30"})
    EXPECT_EQ(number(text), std::strtod(text, nullptr)) << text;
}

TEST(TextNumber, ReadsAMillionDigits) {
  const std::string nines(1'000'000, '9');
  EXPECT_EQ(number(fmt::format("0.{}", nines)), 1.0);
  EXPECT_EQ(number(fmt::format("0.{:0>1000000}", 1)), 0.0);
  EXPECT_TRUE(std::isinf(number(nines)));
  EXPECT_EQ(number(fmt::format("1{:0>300}.{}", 0, nines)), 1e300);
}

TEST(TextNumber, ReadsWhatExportersWrite) {
  EXPECT_EQ(number("+1.5"), 1.5);
  EXPECT_EQ(number(".5"), 0.5);
  EXPECT_EQ(number("5."), 5.0);
  EXPECT_EQ(number("-0"), 0.0);
  EXPECT_TRUE(std::signbit(number("-0.0")));
  EXPECT_EQ(number("1E+3"), 1000.0);
  EXPECT_TRUE(std::isnan(number("nan")));
  EXPECT_EQ(number("-inf"), -INFINITY);
  EXPECT_TRUE(std::isinf(number("1e999999999999999")));
  EXPECT_EQ(number("1e-999999999999999"), 0.0);
}

TEST(TextNumber, RefusesWhatIsNone) {
  for (const std::string text : {"", "-", "+", ".", "-.", "e5", "abc", "--1", "+-1", "/"}) {
    const char* at = text.data();
    double value = 7;
    DigitStatistics digits;
    EXPECT_FALSE(read_number(at, text.data() + text.size(), value, digits)) << text;
    EXPECT_EQ(at, text.data()) << text;
  }
}

TEST(TextNumber, StopsBehindTheNumber) {
  const std::string text = "12.5e 3";
  const char* at = text.data();
  double value = 0;
  DigitStatistics digits;
  ASSERT_TRUE(read_number(at, text.data() + text.size(), value, digits));
  EXPECT_EQ(value, 12.5);
  EXPECT_EQ(at, text.data() + 4);
}

double half_spacing(std::initializer_list<const char*> numbers) {
  DigitStatistics digits;
  double largest = 0;
  for (const std::string text : numbers) {
    const char* at = text.data();
    double value = 0;
    EXPECT_TRUE(read_number(at, text.data() + text.size(), value, digits));
    largest = std::max(largest, std::fabs(value));
  }
  return text_half_spacing(digits, largest);
}

TEST(TextPrecision, FollowsTheNotation) {
  EXPECT_DOUBLE_EQ(half_spacing({"1234.567890", "0.000001"}), 0.5e-6);       // %f
  EXPECT_DOUBLE_EQ(half_spacing({"1234.57", "0.000123457", "12"}), 0.5e-2);  // %g
  EXPECT_DOUBLE_EQ(half_spacing({"1.23457e+06", "1"}), 5);                   // %g, large
  EXPECT_DOUBLE_EQ(half_spacing({"-336000.25", "7"}), 0.5e-2);
}

TEST(TextPrecision, SeesFloat32InManyDigits) {
  const double at_65536 = std::ldexp(1.0, -8);
  EXPECT_DOUBLE_EQ(half_spacing({"65536.781250000", "-144.617706299", "12.000000000"}), at_65536);
  EXPECT_DOUBLE_EQ(half_spacing({"65536.78125", "-1.446177062988281e+02", "0.1"}), at_65536);
  EXPECT_DOUBLE_EQ(half_spacing({"65536.781250", "2038.410278"}), at_65536) << "%f";
  // One number that float32 has not is enough.
  EXPECT_DOUBLE_EQ(half_spacing({"65536.781250000", "144.617700000"}), 0.5e-9);
  EXPECT_DOUBLE_EQ(half_spacing({"65536.781250000", "0.10000000000000001"}), 0.5e-12);
  // Design values in fixed notation say nothing of it, nor do digits that float32 needs.
  EXPECT_DOUBLE_EQ(half_spacing({"65536.000000000", "1200.500000000"}), 0.5e-9);
  EXPECT_DOUBLE_EQ(half_spacing({"65536.7812", "144.617706"}), 0.5e-4);
}

TEST(TextPrecision, TakesDesignValuesAsFloat32) {
  EXPECT_DOUBLE_EQ(half_spacing({"0", "1000"}), std::ldexp(1.0, -15));
  EXPECT_DOUBLE_EQ(half_spacing({"0", "0"}), std::ldexp(1.0, -150));
  EXPECT_DOUBLE_EQ(half_spacing({"0", "336000"}), std::ldexp(1.0, -6)) << "whole, written in full";
}

}  // namespace
}  // namespace strake::io
