// SPDX-License-Identifier: Apache-2.0
// Readers of the tables of views, and of tags, grid lines and styles.
#include "sheets/parse/table_readers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "core/number.hpp"
#include "core/units.hpp"
#include "hlr/view/view_frustum.hpp"
#include "sheets/labels/tags.hpp"
#include "sheets/spec/template.hpp"
#include "strake/drawing/object_styles.hpp"
#include "strake/drawing/view.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::sheets {

namespace {

using geometry::Vec3d;
using geometry::Vec3l;
using settings::Array;
using settings::TableReader;
using settings::Value;

/// Returns an array such as [1, -2.5, 1] as "1,-2.5,1"; nothing for anything else.
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

void ViewReader::direction(TableReader& table, ViewSpec& view) {
  if (const auto direction = vector(table, "direction", true)) {
    view.view.direction = *direction;
    view.view.up = drawing::default_up(*direction);
  }
  up(table, view);
}

void ViewReader::up(TableReader& table, ViewSpec& view) {
  if (const auto up = vector(table, "up", false)) view.view.up = *up;
  if (!drawing::can_be_up(view.view.up, view.view.direction))
    reading_.fault(table.at(), "'up' of " + table.what() + " is parallel to its direction",
                   "give a direction that shows on paper");
}

void ViewReader::read_perspective(TableReader& table, ViewSpec& view) {
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

void ViewReader::perspective(TableReader& table, ViewSpec& view) {
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
  const auto direction = drawing::set_perspective(perspective, view.view);
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

void ViewReader::limits(TableReader& outer, ViewSpec& view) {
  const Value* const value = outer.value("limits");
  if (value == nullptr) return;
  const auto* const word = std::get_if<std::string>(&value->held);
  view.leaves_far_objects_out = word != nullptr && *word == "auto";
  view.view.limits.reset();
  if (view.leaves_far_objects_out) return;
  if (!std::holds_alternative<settings::Table>(value->held)) {
    reading_.fault(value->at, "'limits' of " + outer.what() + " is neither a box nor \"auto\"",
                   "write limits = { min = [\"0m\", \"0m\", \"0m\"], max = [\"9m\", \"9m\", "
                   "\"3m\"] }, or \"auto\" to leave out what lies far from all else");
    return;
  }
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

void ViewReader::select(TableReader& table, ViewSpec& view) {
  if (table.value("select") == nullptr) return;
  view.select = choosers(table, "select");
}

void ViewReader::uncut(TableReader& table, ViewSpec& view) {
  if (table.value("uncut") != nullptr) view.uncut = choosers(table, "uncut");
}

std::vector<settings::Chooser> ViewReader::choosers(TableReader& table, const std::string& key) {
  std::vector<settings::Chooser> all;
  const Value* const value = table.value(key);
  if (value == nullptr) return all;
  const std::string what = table.what() + ", " + key;
  const auto take = [&](const Value& one) {
    if (auto chooser = sets_.chooser(one, what)) all.push_back(std::move(*chooser));
  };
  const auto* const list = std::get_if<Array>(&value->held);
  if (list == nullptr) {
    take(*value);
    return all;
  }
  for (const Value& one : *list) take(one);
  // An empty list of `uncut` takes back what [defaults] or [arrangement] say.
  if (list->empty() && key == "select")
    reading_.fault(value->at, "'select' of " + table.what() + " picks nothing",
                   "leave it out for everything");
  return all;
}

void ViewReader::hatches(TableReader& table, ViewSpec& view) {
  const Value* const value = table.value("hatch");
  if (value == nullptr) return;
  view.hatches.clear();
  const auto* const list = std::get_if<Array>(&value->held);
  if (list == nullptr) return hatch(*value, table.what(), view);
  for (const Value& one : *list) hatch(one, table.what(), view);
}

void ViewReader::hatch(const Value& value, const std::string& outer, ViewSpec& view) {
  TableReader table(reading_, value, "'hatch' of " + outer);
  HatchSpec spec;
  spec.select = choosers(table, "select");
  if (const auto angle =
          table.quantity("angle", parse_angle_deg, "an angle in quotes, as \"45deg\"")) {
    if (!(*angle >= 0 && *angle <= 180))
      reading_.fault(table.value("angle")->at, "'angle' of " + table.what() + " is no way of lines",
                     "write \"0deg\" to \"180deg\"");
    spec.hatch.angle_deg = *angle;
  }
  if (const auto spacing = table.tolerance_mm("spacing")) spec.hatch.spacing_mm = *spacing;
  view.hatches.push_back(std::move(spec));
}

void ViewReader::sections(TableReader& table, ViewSpec& view) {
  const Value* const value = table.value("sections");
  if (value == nullptr) return;
  view.sections.clear();
  const std::string mend =
      "write sections = [\"z>4500mm\", \"x<0m\"], with the sign towards what is cut away, or "
      "\"z=4500mm\" to cut away what is nearer to the viewer";
  const auto take = [&](const Value& one) {
    const auto* const text = std::get_if<std::string>(&one.held);
    // Which side is nearer differs from view to view: place_sections() says so later.
    std::string plane = text != nullptr ? *text : std::string();
    std::ranges::replace(plane, '=', '>');
    if (text != nullptr && drawing::parse_section(plane, Vec3l{}))
      view.sections.push_back({*text, one.at});
    else
      reading_.fault(one.at, "'sections' of " + table.what() + " has what is no section plane",
                     mend);
  };
  const auto* const list = std::get_if<Array>(&value->held);
  if (list == nullptr) return take(*value);
  for (const Value& one : *list) take(one);
}

void ViewReader::place_sections(ViewSpec& view) {
  view.view.sections.clear();
  const auto eye = view.view.perspective ? std::optional(view.view.perspective->eye) : std::nullopt;
  for (const SectionSpec& section : view.sections) {
    const auto parsed = drawing::parse_section(section.text, view.view.direction, eye);
    if (parsed)
      view.view.sections.push_back(parsed->section);
    else
      reading_.fault(section.at, "in the view '" + view.name + "' " + parsed.error().message,
                     parsed.error().mend);
  }
}

void ViewReader::conventions(TableReader& table, ViewSpec& view) {
  // Reads a text by the parser that the command line has for the same option.
  const auto read = [&](const std::string& key, auto&& parse, auto& into) {
    const auto text = table.text(key);
    if (!text) return;
    const auto options = parse(*text);
    if (options)
      into = *options;
    else
      reading_.fault(table.value(key)->at,
                     "'" + key + "' of " + table.what() + ": " + options.error().message,
                     options.error().mend);
  };
  read("centre_lines", drawing::parse_centre_lines, view.conventions.centre_lines);
  read("thin", drawing::parse_thinning, view.conventions.thin);
  read("single_line", model::parse_single_line, view.single_line);
  constexpr std::array<std::string_view, 2> kOnOff{"off", "on"};
  if (const auto word = table.word("break_lines", kOnOff))
    view.conventions.break_lines = *word == "on";
  if (const auto word = table.word("match_lines", kOnOff))
    view.match_lines = view.match_lines_own = *word == "on";
}

void ViewReader::content(TableReader& table, ViewSpec& view) {
  select(table, view);
  limits(table, view);
  sections(table, view);
  uncut(table, view);
  hatches(table, view);
  conventions(table, view);
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
  constexpr std::array<std::string_view, 2> kOwnPolylines{"visible", "hidden"};
  if (const auto word = table.word("own_polylines", kOwnPolylines))
    view.options.own_polylines =
        *word == "hidden" ? hlr::OwnPolylines::hidden : hlr::OwnPolylines::visible;
  constexpr std::array<std::string_view, 3> kSmooth{"off", "tangent", "on"};
  if (const auto word = table.word("smooth", kSmooth))
    view.options.smooth = *word == "on"        ? hlr::Smooth::all
                          : *word == "tangent" ? hlr::Smooth::tangent
                                               : hlr::Smooth::off;
  constexpr std::array<std::string_view, 2> kOnOff{"on", "off"};
  if (const auto word = table.word("flush_seams", kOnOff)) view.options.flush_seams = *word == "on";
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

namespace {

using settings::KeyValue;

constexpr std::size_t kMaxPlanes = 10000;
constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};

}  // namespace

std::vector<std::string> MarkReader::views(TableReader& table) {
  std::vector<std::string> names = table.texts("views");
  for (const std::string& name : names) {
    std::string known;
    bool there = false;
    for (const ViewSpec& view : found_.views) {
      there = there || view.name == name;
      known += (known.empty() ? "" : ", ") + view.name;
    }
    if (!there)
      reading_.fault(table.at(),
                     "'views' of " + table.what() + " names '" + name +
                         "', but the sheet has no view '" + name + "'",
                     known.empty()
                         ? "no views are defined: add [[view]] with name = \"" + name + "\""
                         : "its views are " + known);
  }
  return names;
}

void MarkReader::tag(const Value& value) {
  TableReader table(reading_, value, "[[tag]]");
  TagSpec tag;
  tag.where = place(value.at) + ": [[tag]]";
  tag.select = sets_.required(table, "select");
  tag.text = table.required_text("text");
  const Result<std::vector<TextPiece>> pieces = split_placeholders(tag.text);
  const Value* const text = table.value("text");
  if (text != nullptr && !pieces)
    reading_.fault(text->at, "'text' of [[tag]]: " + pieces.error().message, pieces.error().mend);
  for (std::size_t p = 0; text != nullptr && pieces && p < pieces->size(); ++p)
    if (const std::string& name = (*pieces)[p].name; !name.empty() && !is_tag_name(name))
      reading_.fault(text->at, "'text' of [[tag]] has {{" + name + "}}",
                     "write {{name}}, {{id}}, {{path}}, {{file}}, {{type}} or {{@ATTRIBUTE}}");
  tag.views = views(table);
  constexpr std::array<std::string_view, 3> kStyles{"leader", "plain", "along"};
  const std::string style = table.word("style", kStyles).value_or("leader");
  tag.style = static_cast<TagSpec::Style>(std::ranges::find(kStyles, style) - kStyles.begin());
  tag.once = table.flag("once").value_or(false);
  if (const auto height = table.tolerance_mm("height")) {
    tag.height_mm = *height;
    if (!(*height >= 0.5 && *height <= 100))
      reading_.fault(table.value("height")->at, "letters of this height cannot be read",
                     "write a height of capital letters from 0.5mm to 100mm");
  }
  found_.tags.push_back(std::move(tag));
}

void MarkReader::grid(const Value& value) {
  TableReader table(reading_, value, "[grid]");
  found_.grid.where = place(value.at) + ": [grid]";
  found_.grid.views = views(table);
  for (std::uint8_t axis = 0; axis < 3; ++axis) planes(table, axis);
  for (const Value* one : table.tables("series")) series(*one);
  if (found_.grid.planes.size() > kMaxPlanes)
    reading_.fault(value.at, "a grid of more than 10000 lines", "give those that are drawn");
}

void MarkReader::planes(TableReader& table, std::uint8_t axis) {
  const std::string key(kAxes.at(axis));
  const Value* const value = table.value(key);
  if (value == nullptr) return;
  const std::string mend = "write " + key + " = [[\"FR 10\", \"6m\"], [\"FR 11\", \"6.6m\"]]";
  const auto* const list = std::get_if<Array>(&value->held);
  if (list == nullptr)
    reading_.fault(value->at, "'" + key + "' of [grid] is no list of lines", mend);
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const auto* const pair = std::get_if<Array>(&(*list)[i].held);
    const auto* const label = pair != nullptr && pair->size() == 2
                                  ? std::get_if<std::string>(&pair->front().held)
                                  : nullptr;
    if (label == nullptr) {
      reading_.fault((*list)[i].at, "'" + key + "' of [grid] has a line without label or place",
                     mend);
      return;
    }
    if (const auto at = table.length_mm(pair->back(), key))
      found_.grid.planes.push_back({axis, *label, *at});
  }
}

void MarkReader::series(const Value& value) {
  TableReader table(reading_, value, "[[grid.series]]");
  const auto axis = table.word("axis", kAxes);
  const std::string label = table.required_text("label");
  const auto first = table.whole("first"), last = table.whole("last");
  const Value* const at = table.value("at");
  const auto from = at != nullptr ? table.length_mm(*at, "at") : std::optional(0.0);
  const auto spacing = table.tolerance_mm("spacing");
  const auto pieces = split_placeholders(label);
  const bool numbered = pieces && pieces->size() == 2 && pieces->front().name == "n";
  if (!numbered)
    reading_.fault(value.at, "'label' of [[grid.series]] does not say where the number goes",
                   "write label = \"FR {{n}}\"");
  if (!axis || !first || !last || !spacing || !(*spacing > 0))
    reading_.fault(value.at, "[[grid.series]] is not complete",
                   "write axis = \"x\", first = 0, last = 40, at = \"0m\", spacing = \"600mm\"");
  constexpr std::int64_t kFarthest = 1000000;
  if (!first || !last || *first < -kFarthest || *last > kFarthest || *last < *first ||
      *last - *first >= static_cast<std::int64_t>(kMaxPlanes)) {
    reading_.fault(value.at, "'first' and 'last' of [[grid.series]] are no numbers of lines",
                   "count upwards, 10000 lines at most");
    return;
  }
  if (!reading_.good()) return;
  const auto number =
      static_cast<std::uint8_t>(std::find(kAxes.begin(), kAxes.end(), *axis) - kAxes.begin());
  for (std::int64_t n = *first; n <= *last; ++n)
    found_.grid.planes.push_back(
        {number, fill_placeholders(*pieces, [&](const std::string&) { return std::to_string(n); }),
         *from + static_cast<double>(n - *first) * *spacing});
}

void MarkReader::styles(const Value& value) {
  TableReader table(reading_, value, "[styles]");
  for (const KeyValue* entry : table.others()) style(*entry);
}

void MarkReader::style(const KeyValue& entry) {
  std::string known;
  std::size_t line = 0;
  for (; line < kLineClasses && class_name(static_cast<LineClass>(line)) != entry.key; ++line)
    known += (line == 0 ? "" : ", ") + std::string(class_name(static_cast<LineClass>(line)));
  if (line == kLineClasses) {
    reading_.fault(entry.at, "no lines are called '" + entry.key + "'", "the classes are " + known);
    return;
  }
  TableReader table(reading_, entry.value, "[styles." + entry.key + "]");
  StyleSpec& spec = found_.styles.at(line);
  const auto name = static_cast<LineClass>(line);
  if (name == LineClass::hidden_self || name == LineClass::hidden_other) found_.split_hidden = true;
  spec.width_mm = table.tolerance_mm("width");
  if (spec.width_mm && !(*spec.width_mm >= 0.01 && *spec.width_mm <= 20))
    reading_.fault(table.value("width")->at, "no pen is so wide", "write \"0.01mm\" to \"20mm\"");
  if (const Value* const dash = table.value("dash")) {
    const auto* const list = std::get_if<Array>(&dash->held);
    const std::size_t count = list != nullptr ? list->size() : 1;
    if (count % 2 != 0 || count > 12)
      reading_.fault(dash->at, "'dash' of " + table.what() + " is no list of dashes and gaps",
                     "write dash = [\"3mm\", \"0.75mm\"], or dash = [] for a continuous line");
    else
      spec.dash_mm.emplace();
    for (std::size_t k = 0; spec.dash_mm && k < count; ++k) {
      const double length = table.length_mm((*list)[k], "dash").value_or(0);
      if (!(length >= 0.01 && length <= 1000))
        reading_.fault((*list)[k].at, "'dash' of " + table.what() + " has a length out of bounds",
                       "write \"0.01mm\" to \"1m\"");
      spec.dash_mm->push_back(length);
    }
  }
  if (const auto text = table.text("color")) {
    const auto color = drawing::parse_color(*text);
    if (color)
      spec.color = *color;
    else
      reading_.fault(table.value("color")->at, color.error().message, color.error().mend);
  }
}

}  // namespace strake::sheets
