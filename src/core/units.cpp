// SPDX-License-Identifier: Apache-2.0
#include "core/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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
/// Scales beyond these are typing errors, and their sheets no paper.
constexpr double kLargestBlowUp = 1e-6, kLargestReduction = 1e9;
constexpr double kDegPerRad = 57.29577951308232;

Error usage(std::string message, std::string mend) {
  return {ErrorCode::usage, std::move(message), {}, std::move(mend)};
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
  return usage("no length unit: " + in_quotes(text), "write " + std::string(kUnitNames));
}

Result<double> parse_length_mm(std::string_view text) {
  const auto q = parse_quantity(text);
  if (!q) return usage("no length: " + in_quotes(text), "write a number and a unit, as 25mm");
  if (q->unit.empty()) {
    if (q->number == 0) return 0.0;
    return usage("the length " + in_quotes(text) + " has no unit",
                 "write " + shortest(q->number) + "mm or another of " + std::string(kUnitNames));
  }
  const auto mm = unit_mm(q->unit);
  if (!mm)
    return usage("unknown unit " + in_quotes(q->unit) + " in " + in_quotes(text),
                 "write " + std::string(kUnitNames));
  const double length = q->number * *mm;
  if (!std::isfinite(length))
    return usage("too long: " + in_quotes(text), "write a smaller length");
  return length;
}

Result<double> parse_angle_deg(std::string_view text) {
  const auto q = parse_quantity(text);
  if (!q) return usage("no angle: " + in_quotes(text), "write degrees, as 20deg");
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
      return usage("no scale for a sheet of paper: " + in_quotes(text),
                   "write 1:50, say; 1000000:1 to 1:1000000000 can be drawn");
    }
  }
  return usage("no scale: " + in_quotes(text), "write paper to model, as 1:50");
}

}  // namespace strake
