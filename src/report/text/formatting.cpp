// SPDX-License-Identifier: Apache-2.0
#include "report/text/formatting.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <ranges>
#include <span>
#include <vector>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "report/text/columns.hpp"

namespace strake::report {
namespace {

constexpr double kPerMm = 1e6;

constexpr std::uint64_t kUnits = 1000000;

/// Returns the millionths nearest to a number that is not negative, as for most numbers is found
/// quickly; nothing for those that are huge, no numbers, or so near the middle between two that
/// only exact arithmetic tells which is nearer.
std::optional<std::uint64_t> millionths_quickly(double size) {
  if (!(size < 1e9)) return std::nullopt;
  const auto whole = static_cast<std::uint64_t>(size);
  // The fraction is exact, its product off by less than a billionth.
  const double scaled = (size - static_cast<double>(whole)) * kPerMm;
  const auto below = static_cast<std::uint64_t>(scaled);
  const double rest = scaled - static_cast<double>(below);
  if (std::fabs(rest - 0.5) < 1e-6) return std::nullopt;
  return whole * kUnits + below + (rest > 0.5 ? 1U : 0U);
}

/// Appends what append_mm() gives for most numbers, in a third of the time. Returns false, and
/// appends nothing, for all others.
bool append_mm_quickly(std::string& out, double mm) {
  const std::optional<std::uint64_t> found = millionths_quickly(std::fabs(mm));
  if (!found) return false;
  const std::uint64_t units = *found;
  if (mm < 0 && units != 0) out += '-';
  std::array<char, 24> digits{};
  out.append(digits.data(),
             std::to_chars(digits.data(), digits.data() + digits.size(), units / kUnits).ptr);
  std::uint64_t fraction = units % kUnits;
  if (fraction == 0) return true;
  out += '.';
  for (std::uint64_t place = kUnits / 10; fraction != 0; fraction %= place, place /= 10)
    out += static_cast<char>('0' + fraction / place);
  return true;
}

/// Returns a whole number that fits; the outermost where it does not, 0 where it is none.
std::int64_t saturated(double whole) {
  if (std::isnan(whole)) return 0;
  constexpr double kMax = 9223372036854774784.0;  // the largest double below 2^63
  return static_cast<std::int64_t>(std::clamp(whole, -kMax, kMax));
}

}  // namespace

void append_range(std::string& out, double lower_mm, double upper_mm, std::string_view between) {
  append_mm_floor(out, lower_mm);
  out += between;
  append_mm_ceil(out, upper_mm);
}

void append_point(std::string& out, const geometry::Vec3d& mm, std::string_view between) {
  for (int k = 0; k < 3; ++k) {
    if (k > 0) out += between;
    append_mm(out, mm[k]);
  }
}

void append_flags(std::string& out, std::uint16_t flags, std::string_view between,
                  std::string_view quote) {
  bool first = true;
  for (const std::string_view flag : clash::flag_names(flags)) {
    if (!first) out += between;
    first = false;
    out += quote;
    out += flag;
    out += quote;
  }
}

void append_json(std::string& out, std::string_view text) { append_json_string(out, text); }

void append_mm(std::string& out, double mm) {
  if (append_mm_quickly(out, mm)) return;
  const std::size_t start = out.size();
  append_fixed(out, mm, 6);
  while (out.back() == '0') out.pop_back();
  if (out.back() == '.') out.pop_back();
  if (out.compare(start, std::string::npos, "-0") == 0) out.replace(start, 2, "0");
}

std::int64_t millionths(double value) {
  if (const std::optional<std::uint64_t> found = millionths_quickly(std::fabs(value)))
    return value < 0 ? -static_cast<std::int64_t>(*found) : static_cast<std::int64_t>(*found);
  if (!(std::fabs(value) < 9e12)) return saturated(value * kPerMm);
  std::string digits = fixed(value, 6);
  std::erase(digits, '.');
  return parse_integer(digits).value_or(0);
}

std::int64_t millionths_floor(double value) { return saturated(std::floor(value * kPerMm)); }
std::int64_t millionths_ceil(double value) { return saturated(std::ceil(value * kPerMm)); }

void append_mm_floor(std::string& out, double mm) {
  append_mm(out, std::floor(mm * kPerMm) / kPerMm);
}

void append_mm_ceil(std::string& out, double mm) {
  append_mm(out, std::ceil(mm * kPerMm) / kPerMm);
}

std::string_view short_class_name(clash::Class cls) {
  return cls == clash::Class::clearance_violation ? "CLEARANCE" : clash::name(cls);
}

namespace {

/// A printable character with the columns that it takes.
struct ShownCharacter {
  std::string_view bytes;
  std::size_t columns = 1;
};

std::vector<ShownCharacter> shown_characters(std::string_view text) {
  std::vector<ShownCharacter> shown;
  while (!text.empty()) {
    const DecodedCharacter c = decode_character(text);
    shown.push_back(is_printable(c) ? ShownCharacter{c.bytes, columns_of(c.code)}
                                    : ShownCharacter{"?"});
  }
  return shown;
}

/// Returns how many of the characters fit.
template <class Characters>
std::size_t count_fitting(const Characters& characters, std::size_t columns) {
  std::size_t count = 0;
  for (const ShownCharacter& c : characters) {
    if (c.columns > columns) break;
    columns -= c.columns;
    ++count;
  }
  return count;
}

std::string bytes_of(std::span<const ShownCharacter> characters) {
  std::string out;
  for (const ShownCharacter& c : characters) out += c.bytes;
  return out;
}

}  // namespace

std::string fit_to_columns(std::string_view text, std::size_t columns) {
  const std::vector<ShownCharacter> shown = shown_characters(text);
  const std::span all(shown);
  if (count_fitting(all, columns) == all.size()) return left_aligned(bytes_of(all), columns);
  if (columns == 0) return {};
  // The tail of a name tells more than its head, so it gets the larger half.
  const std::size_t head = (columns - 1) / 2, tail = columns - 1 - head;
  std::span rest = all.last(count_fitting(std::views::reverse(all), tail));
  // A mark whose character is left out would stand over the dots.
  while (!rest.empty() && rest.front().columns == 0) rest = rest.subspan(1);
  return left_aligned(bytes_of(all.first(count_fitting(all, head))) + "…" + bytes_of(rest),
                      columns);
}

}  // namespace strake::report
