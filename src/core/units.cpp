// SPDX-License-Identifier: Apache-2.0
#include "core/units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "core/number.hpp"
#include "core/text_encoding.hpp"

namespace strake {

namespace {

constexpr std::array<std::pair<std::string_view, double>, 27> kUnits{{
    {"um", 0.001},      {"µm", 0.001},      {"micrometre", 0.001}, {"micrometer", 0.001},
    {"mm", 1},          {"millimetre", 1},  {"millimeter", 1},     {"cm", 10},
    {"centimetre", 10}, {"centimeter", 10}, {"dm", 100},           {"decimetre", 100},
    {"decimeter", 100}, {"m", 1000},        {"metre", 1000},       {"meter", 1000},
    {"km", 1e6},        {"kilometre", 1e6}, {"kilometer", 1e6},    {"in", 25.4},
    {"inch", 25.4},     {"inches", 25.4},   {"\"", 25.4},          {"ft", 304.8},
    {"foot", 304.8},    {"feet", 304.8},    {"'", 304.8},
}};
constexpr std::string_view kUnitNames = "um, mm, cm, dm, m, km, in or ft";
constexpr std::array<std::pair<std::string_view, double>, 18> kVolumes{{
    {"mm3", 1},
    {"mm³", 1},
    {"cm3", 1e3},
    {"cm³", 1e3},
    {"dm3", 1e6},
    {"dm³", 1e6},
    {"l", 1e6},
    {"L", 1e6},
    {"litre", 1e6},
    {"litres", 1e6},
    {"liter", 1e6},
    {"liters", 1e6},
    {"m3", 1e9},
    {"m³", 1e9},
    {"in3", 16387.064},
    {"in³", 16387.064},
    {"ft3", 28316846.592},
    {"ft³", 28316846.592},
}};
constexpr std::string_view kVolumeNames = "mm3, cm3, dm3, l, m3, in3 or ft3";
/// Scales beyond these are typing errors, and their sheets no paper.
constexpr double kLargestBlowUp = 1e-6, kLargestReduction = 1e9;
constexpr double kDegPerRad = 57.29577951308232;

Error usage(std::string message, std::string mend) {
  return {ErrorCode::usage, std::move(message), {}, std::move(mend)};
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Returns how to write a number with a decimal comma, "1.5mm" for "1,5mm"; nothing for other
/// texts.
std::optional<std::string> with_decimal_point(std::string_view text) {
  text = trimmed(text);
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || comma == 0 || comma + 1 == text.size() ||
      !is_digit(text[comma - 1]) || !is_digit(text[comma + 1]))
    return std::nullopt;
  const std::size_t end = std::min(text.find_first_not_of("0123456789", comma + 1), text.size());
  if (end < text.size() && text[end] == ',') return std::nullopt;
  std::string other(text);
  other[comma] = '.';
  if (end - comma != 4) return other;
  // Three digits may be thousands.
  return other + " or " + std::string(text.substr(0, comma)) + std::string(text.substr(comma + 1));
}

/// Says of a text that begins with a number too near to 0, or too far from it, that it does.
std::optional<Error> out_of_range(std::string_view text) {
  const std::string_view shown = trimmed(text);
  std::string_view digits = shown;
  if (digits.starts_with('+') || digits.starts_with('-')) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc::result_out_of_range) return std::nullopt;
  digits = digits.substr(0, static_cast<std::size_t>(end - digits.data()));
  const std::size_t exponent = digits.find_first_of("eE");
  const bool small = exponent == std::string_view::npos
                         ? digits.front() == '0' || digits.front() == '.'
                         : digits.find('-', exponent) != std::string_view::npos;
  if (small) return usage(in_quotes(shown) + " is too small to be told from 0", "write 0, or more");
  return usage(in_quotes(shown) + " is too large", "write a smaller number");
}

/// Returns what is wrong with a text that does not begin with a number.
Error no_quantity(std::string_view text, const std::string& what, std::string mend) {
  if (const auto error = out_of_range(text)) return *error;
  return usage(in_quotes(text) + " is not " + what, std::move(mend));
}

Error decimal_comma(std::string_view text, const std::string& mend) {
  return usage(in_quotes(text) + " has a comma in its number", "write " + mend);
}

/// Returns a quantity with a unit of length in millimetres.
Result<double> in_mm(const Quantity& quantity, std::string_view text) {
  const auto mm = unit_mm(quantity.unit);
  if (!mm)
    return usage("unknown unit " + in_quotes(quantity.unit) + " in " + in_quotes(text),
                 "write " + std::string(kUnitNames));
  const double length = quantity.number * *mm;
  if (!std::isfinite(length))
    return usage("too long: " + in_quotes(text), "write a smaller length");
  return length;
}

}  // namespace

std::optional<Quantity> parse_quantity(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  text = trimmed(text);
  // The longest prefix that is a number: "1e3m" is a thousand metres, "1em" no number at all.
  for (std::size_t length = std::min(text.size(), kLongest); length > 0; --length)
    if (const auto number = parse_number(trimmed(text.substr(0, length)))) {
      const std::string_view unit = trimmed(text.substr(length));
      // A remainder of a number that is too large or too small, as 1e400, is no unit.
      if (!unit.empty() && unit.front() >= '0' && unit.front() <= '9') return std::nullopt;
      return Quantity{*number, std::string(unit)};
    }
  return std::nullopt;
}

std::optional<double> unit_mm(std::string_view unit) {
  for (const auto& [name, mm] : kUnits)
    if (unit == name || (name.size() > 4 && unit.size() == name.size() + 1 && unit.back() == 's' &&
                         unit.starts_with(name)))
      return mm;
  return std::nullopt;
}

Result<double> parse_unit_mm(std::string_view text) {
  if (const auto mm = unit_mm(trimmed(text))) return *mm;
  return usage(in_quotes(text) + " is not a unit of length", "write " + std::string(kUnitNames));
}

Result<double> parse_length_mm(std::string_view text) {
  if (const auto point = with_decimal_point(text)) return decimal_comma(text, *point);
  const auto q = parse_quantity(text);
  if (!q) return no_quantity(text, "a length", "write a number and a unit, as 25mm");
  if (!q->unit.empty()) return in_mm(*q, text);
  if (q->number == 0) return 0.0;
  return usage("the length " + in_quotes(text) + " has no unit",
               "write " + shortest(q->number) + "mm or another of " + std::string(kUnitNames));
}

Result<double> parse_distance_mm(std::string_view text) {
  // Of "-1" the sign is wrong before the unit is.
  if (const auto q = parse_quantity(text);
      q && q->number < 0 && (q->unit.empty() || unit_mm(q->unit)))
    return usage(in_quotes(text) + " is negative", "write a length from 0 to 1km");
  Result<double> length = parse_length_mm(text);
  if (length && *length > kLongestMm)
    return usage(in_quotes(text) + " is longer than a kilometre", "write a length from 0 to 1km");
  return length;
}

Result<double> parse_coordinate_mm(std::string_view text) {
  if (const auto point = with_decimal_point(text)) return decimal_comma(text, *point);
  const auto q = parse_quantity(text);
  if (!q)
    return no_quantity(text, "a coordinate", "write millimetres, or a number and a unit, as 4.5m");
  if (q->unit.empty()) return q->number;
  return in_mm(*q, text);
}

Result<double> parse_volume_mm3(std::string_view text) {
  if (const auto point = with_decimal_point(text)) return decimal_comma(text, *point);
  const auto q = parse_quantity(text);
  if (!q) return no_quantity(text, "a volume", "write a number and a unit, as 5cm3");
  if (q->number < 0) return usage(in_quotes(text) + " is negative", "write 0, or a volume as 5cm3");
  if (q->unit.empty() && q->number == 0) return 0.0;
  if (q->unit.empty())
    return usage("the volume " + in_quotes(text) + " has no unit",
                 "write " + shortest(q->number) + "cm3 or another of " + std::string(kVolumeNames));
  for (const auto& [name, mm3] : kVolumes) {
    if (q->unit != name) continue;
    if (std::isfinite(q->number * mm3)) return q->number * mm3;
    return usage("too large: " + in_quotes(text), "write a smaller volume");
  }
  if (unit_mm(q->unit))
    return usage(in_quotes(text) + " is a length, not a volume",
                 "write " + std::string(kVolumeNames) + " behind the number");
  return usage("unknown unit " + in_quotes(q->unit) + " in " + in_quotes(text),
               "write " + std::string(kVolumeNames));
}

Result<double> parse_angle_deg(std::string_view text) {
  if (const auto point = with_decimal_point(text)) return decimal_comma(text, *point);
  const auto q = parse_quantity(text);
  if (!q) return no_quantity(text, "an angle", "write degrees, as 20deg");
  if (q->unit.empty() || q->unit == "deg" || q->unit == "°") return q->number;
  if (q->unit == "rad") return q->number * kDegPerRad;
  return usage("unknown unit " + in_quotes(q->unit) + " in " + in_quotes(text),
               "write 20deg or 0.35rad");
}

Result<double> parse_scale(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon != std::string_view::npos) {
    const auto paper = parse_number(trimmed(text.substr(0, colon)));
    const auto real = parse_number(trimmed(text.substr(colon + 1)));
    if (paper && real && *paper > 0 && *real > 0) {
      const double scale = *real / *paper;
      if (scale >= kLargestBlowUp && scale <= kLargestReduction) return scale;
      return usage(in_quotes(text) + " is no scale for a sheet of paper",
                   "write 1:50, say; 1000000:1 to 1:1000000000 can be drawn");
    }
  }
  const auto number = parse_number(trimmed(text));
  return usage(in_quotes(text) + " is not a scale",
               number && *number >= 1 ? "write 1:" + shortest(*number)
                                      : std::string("write paper to model, as 1:50"));
}

}  // namespace strake
