// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "strake/core/result.hpp"

namespace strake {

// Parses values as a user writes them. Each function takes the whole text, except blanks round it,
// and an error says what would have been right.

/// A number and the text that follows it, without blanks: "25 mm" is 25 and "mm", "1e3" has no
/// unit.
struct Quantity {
  double number = 0;
  std::string unit;
};

/// Parses the longest number that a text begins with, and the rest of it as its unit; returns
/// nothing when it does not begin with one. The number ends within 64 characters.
[[nodiscard]] std::optional<Quantity> parse_quantity(std::string_view text);

/// Returns the length of a unit in millimetres: "um", "mm", "cm", "dm", "m", "km", "in", "ft";
/// nothing for others. Names in full ("millimetres", "meter", "inch") are understood too.
[[nodiscard]] std::optional<double> unit_mm(std::string_view unit);

/// Returns unit_mm() as a Result whose error lists the units.
[[nodiscard]] Result<double> parse_unit_mm(std::string_view text);

/// Parses "25mm", "0.5 m", "-1in" in millimetres. A number without a unit is an error, except 0: 25
/// could be millimetres to one reader and metres to the next.
[[nodiscard]] Result<double> parse_length_mm(std::string_view text);

/// The longest distance, far beyond any tolerance that a user can mean: a kilometre.
inline constexpr double kLongestMm = 1e6;

/// Parses a length as above that is not negative and no longer than kLongestMm.
[[nodiscard]] Result<double> parse_distance_mm(std::string_view text);

/// Parses a coordinate of the model: a length of any sign, in millimetres where it has no unit, as
/// programs show them.
[[nodiscard]] Result<double> parse_coordinate_mm(std::string_view text);

/// Parses "5cm3", "0.5 l", "2in³" in cubic millimetres; the units are mm3, cm3, dm3, l, m3, in3 and
/// ft3. A number without a unit is an error, except 0, and so is a negative one.
[[nodiscard]] Result<double> parse_volume_mm3(std::string_view text);

/// Parses "20deg" or "20°" in degrees; a bare number means degrees, "0.35rad" is converted.
[[nodiscard]] Result<double> parse_angle_deg(std::string_view text);

/// Parses "1:50" as 50: how many millimetres of the model one millimetre of paper shows; "2:1" is
/// 0.5. Scales go from 1000000:1 to 1:1000000000.
[[nodiscard]] Result<double> parse_scale(std::string_view text);

}  // namespace strake
