// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace strake::io {

/// How finely a text writes the numbers of an object: what their precision is judged by. Small,
/// because vertices of a pool that many objects share have each their own.
struct DigitStatistics {
  std::int16_t most_significant_digits = 0;  ///< as written, from the first digit that is not zero
  std::int16_t most_decimals = 0;            ///< digits after the point, exponent applied
  bool tells_float32 = false;   ///< some number is what float32 has, to more digits than that needs
  bool beyond_float32 = false;  ///< some number is not what float32 has, as far as its digits go

  void merge(const DigitStatistics& other);
};

/// Reads a decimal number (optional sign, digits, point, exponent; "inf" and "nan" too) at `at`,
/// rounded to nearest as std::from_chars does, and moves `at` behind it. Any number of digits.
/// False, with `at` unmoved, when no number stands there. A number too large for a double is
/// infinite, one too small is zero.
[[nodiscard]] bool read_number(const char*& at, const char* end, double& value,
                               DigitStatistics& digits);

/// Half the spacing of numbers written so at this magnitude, in their unit. Numbers of at most
/// five digits, and whole ones written in full, are taken as exact design values that went through
/// float32; and so are numbers of many digits that are all what float32 has, as programs write them
/// that keep their points in single precision.
[[nodiscard]] double text_half_spacing(const DigitStatistics& digits, double magnitude);

/// A number that may be a coordinate: finite, with room for any unit to scale it.
[[nodiscard]] constexpr bool is_coordinate(double value) {
  constexpr double kMost = 1e200;
  return value >= -kMost && value <= kMost;
}

[[nodiscard]] constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

inline void skip_blanks(const char*& at, const char* end) {
  while (at != end && is_blank(*at)) ++at;
}

/// What is_blank knows, for texts.
inline constexpr std::string_view kBlanks = " \t\r";
/// What separates words in a line that a program of unknown age wrote.
inline constexpr std::string_view kLineBlanks = " \t\r\f\v";

}  // namespace strake::io
