// SPDX-License-Identifier: Apache-2.0
#include "strake/drawing/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <string>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "core/units.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::drawing {

namespace {

using geometry::Vec3d;
using geometry::Vec3l;

constexpr std::int64_t kLargest = std::int64_t{1} << 20;

struct NamedView {
  std::string_view name;
  Vec3l direction;
};
constexpr std::array<NamedView, 7> kNamed = {{{"top", {0, 0, 1}},
                                              {"bottom", {0, 0, -1}},
                                              {"front", {0, -1, 0}},
                                              {"back", {0, 1, 0}},
                                              {"left", {-1, 0, 0}},
                                              {"right", {1, 0, 0}},
                                              {"iso", {1, -1, 1}}}};

Vec3l reduced(const Vec3l& v) {
  const std::int64_t common = std::gcd(std::gcd(v.x, v.y), v.z);
  return common > 1 ? Vec3l{v.x / common, v.y / common, v.z / common} : v;
}

std::int64_t largest_of(const Vec3l& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Reads three decimals as whole numbers of the finest digit among them, when they fit.
bool scale_exactly(const std::array<std::string_view, 3>& texts, Vec3l& out) {
  std::size_t places = 0;
  for (const std::string_view text : texts) {
    if (text.find_first_of("eE") != std::string_view::npos) return false;
    const std::size_t point = text.find('.');
    if (point != std::string_view::npos) places = std::max(places, text.size() - point - 1);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    std::string digits(texts[k]);
    const std::size_t point = digits.find('.');
    std::size_t missing = places;
    if (point != std::string::npos) {
      missing -= digits.size() - point - 1;
      digits.erase(point, 1);
    }
    digits.append(missing, '0');
    const auto value = parse_integer(digits);
    if (!value) return false;
    out[static_cast<int>(k)] = *value;
  }
  // std::abs of the smallest integer does not exist.
  for (int k = 0; k < 3; ++k)
    if (out[k] == INT64_MIN) return false;
  out = reduced(out);
  return largest_of(out) <= kLargest;
}

double sine_between(const Vec3d& a, const Vec3d& b) {
  const Vec3d normal = cross(a, b);
  return std::sqrt(dot(normal, normal) / (dot(a, a) * dot(b, b)));
}

/// Rounds the direction of a vector whose largest component is 1.
Direction rounded_direction(const Vec3d& wanted) {
  Direction direction;
  for (int k = 0; k < 3; ++k)
    direction.vector[k] = std::llround(wanted[k] * static_cast<double>(kLargest));
  direction.vector = reduced(direction.vector);
  direction.rounded = true;
  direction.rounding_error = sine_between(wanted, direction.vector.as<double>());
  return direction;
}

}  // namespace

Result<Vec3l> direction_by_name(std::string_view name) {
  for (const NamedView& named : kNamed)
    if (named.name == name) return named.direction;
  return Error{ErrorCode::usage, fmt::format("no view is called \"{}\"", name), "",
               "use top, bottom, front, back, left, right or iso, or give a direction"};
}

Result<Direction> parse_direction(std::string_view text) {
  const Error malformed{ErrorCode::usage, fmt::format("\"{}\" is not a direction", text), "",
                        "give three numbers as x,y,z that are not all zero"};
  std::array<std::string_view, 3> parts;
  std::array<double, 3> values{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (k == 2)) return malformed;
    parts[k] = trimmed(text.substr(0, comma));
    text.remove_prefix(k == 2 ? text.size() : comma + 1);
    const auto value = parse_number(parts[k]);
    if (!value) return malformed;
    values[k] = *value;
    if (parts[k].starts_with('+')) parts[k].remove_prefix(1);
  }
  const double largest =
      std::max({std::fabs(values[0]), std::fabs(values[1]), std::fabs(values[2])});
  if (!(largest > 0)) return malformed;
  Direction direction;
  if (scale_exactly(parts, direction.vector)) return direction;
  // The division comes first, so that neither huge nor tiny components overflow.
  return rounded_direction({values[0] / largest, values[1] / largest, values[2] / largest});
}

Direction direction_between(const Vec3l& from, const Vec3l& to) {
  Direction direction{reduced(to - from)};
  const auto largest = static_cast<double>(largest_of(direction.vector));
  if (largest <= static_cast<double>(kLargest)) return direction;
  return rounded_direction(direction.vector.as<double>() * (1 / largest));
}

Result<Direction> set_perspective(const hlr::Perspective& perspective, hlr::View& view) {
  if (perspective.eye == perspective.target)
    return Error{ErrorCode::usage, "the eye and the target are the same point", "",
                 "give a target to look at"};
  const Direction direction = direction_between(perspective.target, perspective.eye);
  view.direction = direction.vector;
  view.perspective = perspective;
  return direction;
}

Result<SectionText> parse_section(std::string_view text, const Vec3l& direction,
                                  const std::optional<Vec3l>& eye) {
  const std::string mend =
      "write z>4500mm to cut away what lies above, z<4500mm what lies below, z=4500mm what is "
      "nearer to the viewer; for z also x, y or a normal as 1,2,0";
  const std::size_t at = text.find_first_of("<>=");
  if (at == std::string_view::npos)
    return Error{ErrorCode::usage, fmt::format("\"{}\" is no section plane", text), "", mend};
  const std::string_view axis = trimmed(text.substr(0, at));
  SectionText result;
  Vec3l& normal = result.section.normal;
  const std::size_t named = axis.size() == 1 ? std::string_view("xyz").find(axis) : 3;
  if (named < 3) {
    normal = {named == 0 ? 1 : 0, named == 1 ? 1 : 0, named == 2 ? 1 : 0};
  } else {
    const Result<Direction> parsed = parse_direction(axis);
    if (!parsed)
      return Error{ErrorCode::usage,
                   fmt::format("\"{}\" is neither an axis nor the normal of a plane", axis), "",
                   mend};
    normal = parsed->vector;
    result.rounded = parsed->rounded;
    result.rounding_error = parsed->rounding_error;
  }
  const Result<double> distance = parse_coordinate_mm(trimmed(text.substr(at + 1)));
  if (!distance) return distance.error();
  const Vec3d n = normal.as<double>();
  const double share = *distance / std::sqrt(dot(n, n));
  const auto foot = geometry::snap(Vec3d{n.x * share, n.y * share, n.z * share});
  if (!foot)
    return Error{ErrorCode::usage, fmt::format("\"{}\" lies outside what can be placed", text), "",
                 "give a plane of the model"};
  result.section.point = *foot;
  const double towards =
      dot(normal.as<double>(), (eye ? *eye - result.section.point : direction).as<double>());
  if (text[at] == '=' && towards == 0)
    return Error{ErrorCode::usage,
                 fmt::format("the plane \"{}\" is seen edge-on: neither side is nearer", text), "",
                 "say with > or < which side is cut away"};
  if (text[at] == '<' || (text[at] == '=' && towards < 0)) normal = -normal;
  return result;
}

Vec3l default_up(const Vec3l& direction) {
  if (direction.x == 0 && direction.y == 0) return {0, 1, 0};
  return {0, 0, 1};
}

bool can_be_up(const Vec3l& up, const Vec3l& direction) { return cross(up, direction) != Vec3l{}; }

}  // namespace strake::drawing
