// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace strake::io {

/// How finely a text writes the numbers of an object, from which their precision follows. It is
/// small, because each vertex of a pool that many objects share has its own.
struct DigitStatistics {
  std::int16_t max_significant_digits = 0;  ///< as written, from the first digit that is not zero
  std::int16_t max_decimals = 0;            ///< digits after the point, exponent applied
  bool shows_float32 = false;  ///< some number is a float32 value, with more digits than that needs
  bool beyond_float32 = false;  ///< some number is no float32 value, as far as its digits go

  void merge(const DigitStatistics& other);
};

/// Reads a decimal number (optional sign, digits, point, exponent; "inf" and "nan" too) at `at`,
/// rounded to nearest as std::from_chars does, and moves `at` behind it. It may have any number of
/// digits. Returns false, with `at` unmoved, when there is no number. A number too large for a
/// double is infinite, one too small is zero.
[[nodiscard]] bool read_number(const char*& at, const char* end, double& value,
                               DigitStatistics& digits);

/// Returns half the spacing of numbers written so at this magnitude, in their unit. Numbers of at
/// most five digits, and whole ones written in full, are taken as exact design values that went
/// through float32; and so are numbers of many digits that are all float32 values, as programs
/// write them that keep their points in single precision.
[[nodiscard]] double text_half_spacing(const DigitStatistics& digits, double magnitude);

/// Whether a number may be a coordinate: it is finite, with room for any unit to scale it.
[[nodiscard]] constexpr bool is_coordinate(double value) {
  constexpr double kMax = 1e200;
  return value >= -kMax && value <= kMax;
}

[[nodiscard]] constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

inline void skip_blanks(const char*& at, const char* end) {
  while (at != end && is_blank(*at)) ++at;
}

/// The characters of is_blank(), as a text.
inline constexpr std::string_view kBlanks = " \t\r";
/// The characters that separate words in a line that a program of unknown age wrote.
inline constexpr std::string_view kLineBlanks = " \t\r\f\v";

}  // namespace strake::io
