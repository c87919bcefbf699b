// SPDX-License-Identifier: Apache-2.0
#include "sheets/parse_marks.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include "sheets/placeholders.hpp"
#include "sheets/tags.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::sheets {

namespace {

using settings::Array;
using settings::Entry;
using settings::TableReader;
using settings::Value;

constexpr std::size_t kMostPlanes = 10000;
constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};

std::optional<model::Color> color_of(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  std::array<std::uint8_t, 3> parts{};
  for (std::size_t k = 0; k < 6; ++k) {
    const char c = text[k + 1];
    int digit = -1;
    if (c >= '0' && c <= '9') digit = c - '0';
    if (c >= 'a' && c <= 'f') digit = c - 'a' + 10;
    if (c >= 'A' && c <= 'F') digit = c - 'A' + 10;
    if (digit < 0) return std::nullopt;
    parts[k / 2] = static_cast<std::uint8_t>(parts[k / 2] * 16 + digit);
  }
  return model::Color{parts[0], parts[1], parts[2], 255};
}

}  // namespace

std::vector<std::string> MarkReader::views(TableReader& table) {
  std::vector<std::string> names = table.texts("views");
  for (const std::string& name : names) {
    std::string known;
    bool there = false;
    for (const ViewWish& view : found_.views) {
      there = there || view.name == name;
      known += (known.empty() ? "" : ", ") + view.name;
    }
    if (!there)
      reading_.fault(table.at(), "'views' of " + table.what() + " names '" + name + "'",
                     "the views are " + known);
  }
  return names;
}

void MarkReader::tag(const Value& value) {
  TableReader table(reading_, value, "[[tag]]");
  TagWish tag;
  tag.where = place(value.at) + ": [[tag]]";
  tag.select = sets_.required(table, "select");
  tag.text = table.required_text("text");
  const Result<std::vector<Piece>> pieces = split_placeholders(tag.text);
  const Value* const text = table.value("text");
  if (text != nullptr && !pieces)
    reading_.fault(text->at, "'text' of [[tag]]: " + pieces.error().message, pieces.error().mend);
  for (std::size_t p = 0; text != nullptr && pieces && p < pieces->size(); ++p)
    if (const std::string& name = (*pieces)[p].name; !name.empty() && !is_tag_name(name))
      reading_.fault(text->at, "'text' of [[tag]] has {{" + name + "}}",
                     "write {{name}}, {{id}}, {{path}}, {{file}}, {{type}} or {{@ATTRIBUTE}}");
  tag.views = views(table);
  constexpr std::array<std::string_view, 2> kStyles{"leader", "plain"};
  tag.leader = table.word("style", kStyles).value_or("leader") == "leader";
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
  if (found_.grid.planes.size() > kMostPlanes)
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
      *last - *first >= static_cast<std::int64_t>(kMostPlanes)) {
    reading_.fault(value.at, "'first' and 'last' of [[grid.series]] are no numbers of lines",
                   "count upwards, 10000 lines at most");
    return;
  }
  if (!reading_.good()) return;
  const auto number =
      static_cast<std::uint8_t>(std::find(kAxes.begin(), kAxes.end(), *axis) - kAxes.begin());
  for (std::int64_t n = *first; n <= *last; ++n)
    found_.grid.planes.push_back(
        {number, filled(*pieces, [&](const std::string&) { return std::to_string(n); }),
         *from + static_cast<double>(n - *first) * *spacing});
}

void MarkReader::styles(const Value& value) {
  TableReader table(reading_, value, "[styles]");
  for (const Entry* entry : table.others()) style(*entry);
}

void MarkReader::style(const Entry& entry) {
  std::string known;
  std::size_t line = 0;
  for (; line < kLineClasses && class_name(static_cast<LineClass>(line)) != entry.key; ++line)
    known += (line == 0 ? "" : ", ") + std::string(class_name(static_cast<LineClass>(line)));
  if (line == kLineClasses) {
    reading_.fault(entry.at, "no lines are called '" + entry.key + "'", "the classes are " + known);
    return;
  }
  TableReader table(reading_, entry.value, "[styles." + entry.key + "]");
  StyleWish& wish = found_.styles.at(line);
  wish.width_mm = table.tolerance_mm("width");
  if (wish.width_mm && !(*wish.width_mm >= 0.01 && *wish.width_mm <= 20))
    reading_.fault(table.value("width")->at, "no pen is so wide", "write \"0.01mm\" to \"20mm\"");
  if (const Value* const dash = table.value("dash")) {
    const auto* const list = std::get_if<Array>(&dash->held);
    const std::size_t count = list != nullptr ? list->size() : 1;
    if (count % 2 != 0 || count > 12)
      reading_.fault(dash->at, "'dash' of " + table.what() + " is no list of dashes and gaps",
                     "write dash = [\"3mm\", \"0.75mm\"], or dash = [] for a continuous line");
    else
      wish.dash_mm.emplace();
    for (std::size_t k = 0; wish.dash_mm && k < count; ++k) {
      const double length = table.length_mm((*list)[k], "dash").value_or(0);
      if (!(length >= 0.01 && length <= 1000))
        reading_.fault((*list)[k].at, "'dash' of " + table.what() + " has a length out of bounds",
                       "write \"0.01mm\" to \"1m\"");
      wish.dash_mm->push_back(length);
    }
  }
  if (const auto text = table.text("color")) {
    wish.color = color_of(*text);
    if (!wish.color)
      reading_.fault(table.value("color")->at, "'" + *text + "' is no colour", "write \"#rrggbb\"");
  }
}

}  // namespace strake::sheets
