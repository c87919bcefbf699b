// SPDX-License-Identifier: Apache-2.0
#include "sheets/parse_view.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "hlr/window.hpp"
#include "strake/core/number.hpp"
#include "strake/core/units.hpp"
#include "strake/drawing/view.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::sheets {

namespace {

using geometry::Vec3d;
using geometry::Vec3l;
using settings::Array;
using settings::TableReader;
using settings::Value;

/// [1, -2.5, 1] as "1,-2.5,1"; nothing where it is anything else.
std::optional<std::string> joined(const Value& value) {
  const auto* const list = std::get_if<Array>(&value.held);
  if (list == nullptr || list->size() != 3) return std::nullopt;
  std::string text;
  for (const Value& one : *list) {
    const auto* const whole = std::get_if<std::int64_t>(&one.held);
    const auto* const number = std::get_if<double>(&one.held);
    if (whole == nullptr && (number == nullptr || !std::isfinite(*number))) return std::nullopt;
    text +=
        (text.empty() ? "" : ",") + (whole != nullptr ? std::to_string(*whole) : shortest(*number));
  }
  return text;
}

}  // namespace

std::optional<Vec3l> ViewReader::vector(TableReader& table, std::string_view key, bool names) {
  const Value* const value = table.value(key);
  if (value == nullptr) return std::nullopt;
  const std::string mend = "write " + std::string(key) + " = [1, -1, 1]" +
                           (names ? ", or \"top\", \"bottom\", \"front\", \"back\", \"left\", "
                                    "\"right\" or \"iso\""
                                  : "");
  const auto* const text = std::get_if<std::string>(&value->held);
  if (text != nullptr && names)
    if (const auto named = drawing::direction_by_name(*text)) return *named;
  const auto numbers = text != nullptr ? std::optional(*text) : joined(*value);
  const auto direction = numbers ? std::optional(drawing::parse_direction(*numbers)) : std::nullopt;
  if (direction && *direction) return (*direction)->vector;
  reading_.fault(value->at, "'" + std::string(key) + "' of " + table.what() + " is no direction",
                 mend);
  return std::nullopt;
}

void ViewReader::direction(TableReader& table, ViewWish& view) {
  if (const auto direction = vector(table, "direction", true)) {
    view.view.direction = *direction;
    view.view.up = drawing::default_up(*direction);
  }
  up(table, view);
}

void ViewReader::up(TableReader& table, ViewWish& view) {
  if (const auto up = vector(table, "up", false)) view.view.up = *up;
  if (!drawing::can_be_up(view.view.up, view.view.direction))
    reading_.fault(table.at(), "'up' of " + table.what() + " is parallel to its direction",
                   "give a direction that shows on paper");
}

void ViewReader::seen_from(TableReader& table, ViewWish& view) {
  if (table.value("eye") == nullptr) {
    for (const std::string_view key : {"target", "near", "field_of_view"})
      if (const Value* const value = table.value(key))
        reading_.fault(value->at,
                       "'" + std::string(key) + "' of " + table.what() + " goes with an eye",
                       "write eye = [\"9m\", \"-20m\", \"1.7m\"], or leave it out");
    direction(table, view);
    return;
  }
  if (const Value* const value = table.value("direction"))
    reading_.fault(value->at, "'direction' of " + table.what() + " stands beside an eye",
                   "leave one of the two out");
  perspective(table, view);
  up(table, view);
  if (const Status status = hlr::check_perspective(view.view); !status)
    reading_.fault(table.value("eye")->at, "of " + table.what() + " " + status.error().message,
                   status.error().mend);
}

void ViewReader::perspective(TableReader& table, ViewWish& view) {
  hlr::Perspective perspective;
  const auto eye = point(table, "eye"), target = point(table, "target");
  if (table.value("target") == nullptr)
    reading_.fault(table.value("eye")->at, "the eye of " + table.what() + " has no target",
                   "write target = [\"9m\", \"0m\", \"1m\"], what it looks at");
  if (const auto near = table.tolerance_mm("near")) perspective.near_mm = *near;
  if (const auto angle =
          table.quantity("field_of_view", parse_angle_deg, "an angle in quotes, as \"90deg\""))
    perspective.field_of_view_deg = *angle;
  if (!eye || !target) return;
  perspective.eye = *eye;
  perspective.target = *target;
  const auto direction = drawing::see_from(perspective, view.view);
  if (!direction) {
    reading_.fault(table.value("target")->at,
                   "of " + table.what() + " " + direction.error().message, direction.error().mend);
    return;
  }
  view.view.up = drawing::default_up(view.view.direction);
}

std::optional<Vec3l> ViewReader::point(TableReader& table, std::string_view key) {
  const auto mm = table.point_mm(key);
  if (!mm) return std::nullopt;
  const auto point = geometry::snap(*mm);
  if (!point)
    reading_.fault(
        table.value(key)->at,
        "'" + std::string(key) + "' of " + table.what() + " lies outside what can be placed",
        "write a point of the model");
  return point;
}

std::optional<double> ViewReader::scale(TableReader& table) {
  return table.quantity("scale", parse_scale, "a scale in quotes, as \"1:50\"");
}

void ViewReader::limits(TableReader& outer, ViewWish& view) {
  const Value* const value = outer.table("limits");
  if (value == nullptr) return;
  TableReader table(reading_, *value, "'limits' of " + outer.what());
  const auto lo = table.point_mm("min"), hi = table.point_mm("max");
  const std::string mend =
      "write limits = { min = [\"0m\", \"0m\", \"0m\"], max = [\"9m\", \"9m\", \"3m\"] }";
  if (!lo || !hi) {
    reading_.fault(value->at, table.what() + " wants both corners of its box", mend);
    return;
  }
  const auto from = geometry::snap(*lo), to = geometry::snap(*hi);
  if (!from || !to)
    reading_.fault(value->at, table.what() + " lies outside what can be placed", mend);
  else if (geometry::Box3l{*from, *to}.empty())
    reading_.fault(value->at, table.what() + " ends before it begins",
                   "put the smaller numbers in min");
  else
    view.view.limits = geometry::Box3l{*from, *to};
}

void ViewReader::select(TableReader& table, ViewWish& view) {
  if (table.value("select") == nullptr) return;
  view.select = choosers(table);
}

std::vector<settings::Chooser> ViewReader::choosers(TableReader& table) {
  std::vector<settings::Chooser> all;
  const Value* const value = table.value("select");
  if (value == nullptr) return all;
  const std::string what = table.what() + ", select";
  const auto take = [&](const Value& one) {
    if (auto chooser = sets_.chooser(one, what)) all.push_back(std::move(*chooser));
  };
  const auto* const list = std::get_if<Array>(&value->held);
  if (list == nullptr) {
    take(*value);
    return all;
  }
  for (const Value& one : *list) take(one);
  if (list->empty())
    reading_.fault(value->at, "'select' of " + table.what() + " picks nothing",
                   "leave it out for everything");
  return all;
}

void ViewReader::hatches(TableReader& table, ViewWish& view) {
  const Value* const value = table.value("hatch");
  if (value == nullptr) return;
  view.hatches.clear();
  const auto* const list = std::get_if<Array>(&value->held);
  if (list == nullptr) return hatch(*value, table.what(), view);
  for (const Value& one : *list) hatch(one, table.what(), view);
}

void ViewReader::hatch(const Value& value, const std::string& outer, ViewWish& view) {
  TableReader table(reading_, value, "'hatch' of " + outer);
  HatchWish wish;
  wish.select = choosers(table);
  if (const auto angle =
          table.quantity("angle", parse_angle_deg, "an angle in quotes, as \"45deg\"")) {
    if (!(*angle >= 0 && *angle <= 180))
      reading_.fault(table.value("angle")->at, "'angle' of " + table.what() + " is no way of lines",
                     "write \"0deg\" to \"180deg\"");
    wish.hatch.angle_deg = *angle;
  }
  if (const auto spacing = table.tolerance_mm("spacing")) wish.hatch.spacing_mm = *spacing;
  view.hatches.push_back(std::move(wish));
}

void ViewReader::sections(TableReader& table, ViewWish& view) {
  const Value* const value = table.value("sections");
  if (value == nullptr) return;
  view.view.sections.clear();
  const std::string mend =
      "write sections = [\"z>4500mm\", \"x<0m\"], with the sign towards what is cut away";
  const auto take = [&](const Value& one) {
    const auto* const text = std::get_if<std::string>(&one.held);
    // Without a direction: what is nearer to the viewer may be another side in every view.
    const auto parsed =
        text != nullptr ? std::optional(drawing::parse_section(*text, Vec3l{})) : std::nullopt;
    if (parsed && *parsed)
      view.view.sections.push_back((*parsed)->section);
    else
      reading_.fault(one.at, "'sections' of " + table.what() + " has what is no section plane",
                     mend);
  };
  const auto* const list = std::get_if<Array>(&value->held);
  if (list == nullptr) return take(*value);
  for (const Value& one : *list) take(one);
}

void ViewReader::content(TableReader& table, ViewWish& view) {
  select(table, view);
  limits(table, view);
  sections(table, view);
  hatches(table, view);
  constexpr std::array<std::string_view, 3> kHidden{"off", "dashed", "all"};
  if (const auto word = table.word("hidden", kHidden))
    view.hidden = *word == "off"      ? HiddenLines::off
                  : *word == "dashed" ? HiddenLines::dashed
                                      : HiddenLines::all;
  constexpr std::array<std::string_view, 3> kStages{"none", "local", "global"};
  if (const auto word = table.word("stage", kStages))
    view.options.stage = *word == "none"    ? hlr::Stage::none
                         : *word == "local" ? hlr::Stage::local
                                            : hlr::Stage::global;
  constexpr std::array<std::string_view, 4> kIntersections{"off", "objects", "primitives", "parts"};
  if (const auto word = table.word("intersections", kIntersections))
    view.options.intersections = *word == "off"       ? hlr::Intersections::off
                                 : *word == "objects" ? hlr::Intersections::objects
                                 : *word == "parts"   ? hlr::Intersections::parts
                                                      : hlr::Intersections::primitives;
  constexpr std::array<std::string_view, 3> kSmooth{"off", "tangent", "on"};
  if (const auto word = table.word("smooth", kSmooth))
    view.options.smooth = *word == "on"        ? hlr::Smooth::all
                          : *word == "tangent" ? hlr::Smooth::tangent
                                               : hlr::Smooth::off;
  if (const auto angle =
          table.quantity("sharp_angle", parse_angle_deg, "an angle in quotes, as \"20deg\"")) {
    if (!(*angle >= 0 && *angle <= 180))
      reading_.fault(table.value("sharp_angle")->at,
                     "'sharp_angle' of " + table.what() + " is no angle between two faces",
                     "write \"0deg\" to \"180deg\"");
    view.options.sharp_angle_deg = *angle;
  }
  if (const auto distance = table.tolerance_mm("contact_distance"))
    view.options.contact_distance_mm = *distance;
}

}  // namespace strake::sheets
