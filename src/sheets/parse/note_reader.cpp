// SPDX-License-Identifier: Apache-2.0
#include "sheets/parse/note_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "sheets/labels/tags.hpp"
#include "sheets/spec/template.hpp"
#include "strake/drawing/view.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::sheets {

using settings::Array;
using settings::TableReader;
using settings::Value;

namespace {

constexpr std::size_t kMaxLevels = 1000, kMaxColumns = 12;

}  // namespace

void NoteReader::know_view(const std::string& name, settings::SourcePosition at,
                           const std::string& what) {
  std::string known;
  for (const ViewSpec& view : found_.views) {
    if (view.name == name) return;
    known += (known.empty() ? "" : ", ") + view.name;
  }
  reading_.fault(at, what + " names '" + name + "', but the sheet has no view '" + name + "'",
                 "its views are " + known);
}

void NoteReader::check_names(const ViewSpec& view, settings::SourcePosition at) {
  for (const std::string& name : view.extents_of)
    know_view(name, at, "'extents_of' of the view '" + view.name + "'");
  if (!view.section_mark.empty() && view.sections.empty())
    reading_.fault(at, "the view '" + view.name + "' has a section mark and no section",
                   "write sections = [\"x=4.5m\"], or leave section_mark out");
}

std::optional<PaperPoint> NoteReader::position(TableReader& table) {
  const auto at = table.lengths_mm("position", 2, "[\"150mm\", \"120mm\"]");
  if (!at) return std::nullopt;
  constexpr double kFarthest = 1e6;
  if (!(std::fabs((*at)[0]) <= kFarthest && std::fabs((*at)[1]) <= kFarthest))
    reading_.fault(table.at(), "'position' of " + table.what() + " is far off any sheet",
                   "write millimetres of paper from the upper left corner");
  return PaperPoint{(*at)[0], (*at)[1]};
}

void NoteReader::levels(const Value& value) {
  TableReader table(reading_, value, "[levels]");
  found_.levels.where = place(value, "[levels]");
  found_.levels.views = table.texts("views");
  for (const std::string& name : found_.levels.views)
    know_view(name, table.at(), "'views' of [levels]");
  const Value* const z = table.value("z");
  const auto* const list = z != nullptr ? std::get_if<Array>(&z->held) : nullptr;
  if (list == nullptr || list->empty() || list->size() > kMaxLevels) {
    reading_.fault(z != nullptr ? z->at : value.at, "[levels] has no list of heights",
                   "write z = [\"0m\", [\"DECK 1\", \"1.8m\"]], 1000 at most");
    return;
  }
  for (const Value& one : *list) level(table, one);
}

void NoteReader::level(TableReader& table, const Value& value) {
  const auto* const pair = std::get_if<Array>(&value.held);
  if (pair == nullptr) {
    if (const auto at = table.length_mm(value, "z")) found_.levels.all.push_back({{}, *at});
    return;
  }
  const auto* const label =
      pair->size() == 2 ? std::get_if<std::string>(&pair->front().held) : nullptr;
  if (label == nullptr) {
    reading_.fault(value.at, "'z' of [levels] has a height without label or place",
                   "write z = [\"0m\", [\"DECK 1\", \"1.8m\"]]");
    return;
  }
  if (const auto at = table.length_mm(pair->back(), "z"))
    found_.levels.all.push_back({*label, *at});
}

void NoteReader::scale_bar(const Value& value) {
  TableReader table(reading_, value, "[scale_bar]");
  found_.scale_bar = ScaleBarSpec{place(value, "[scale_bar]"), position(table)};
}

void NoteReader::north(const Value& value) {
  TableReader table(reading_, value, "[north]");
  NorthSpec north;
  north.where = place(value, "[north]");
  if (const auto text = table.text("direction")) {
    const auto parsed = drawing::parse_direction(*text);
    if (parsed)
      north.direction = parsed->vector;
    else
      reading_.fault(table.value("direction")->at, "'direction' of [north] is no direction",
                     "write direction = \"0,1,0\", the way of the model that is north");
  }
  north.view = table.text("view").value_or("");
  if (!north.view.empty()) know_view(north.view, table.at(), "'view' of [north]");
  north.position = position(table);
  found_.north = std::move(north);
}

void NoteReader::parts_list(const Value& value) {
  TableReader table(reading_, value, "[[parts_list]]");
  PartsListSpec list;
  list.where = place(value, "[[parts_list]]");
  list.title = table.text("title").value_or("");
  list.select = sets_.required(table, "select");
  list.position = position(table);
  list.balloons = balloons(table);
  const Value* const columns = table.value("columns");
  const auto* const all = columns != nullptr ? std::get_if<Array>(&columns->held) : nullptr;
  if (all == nullptr || all->empty() || all->size() > kMaxColumns)
    reading_.fault(columns != nullptr ? columns->at : value.at,
                   "[[parts_list]] has no list of columns",
                   "write columns = [[\"NAME\", \"{{name}}\"], [\"DN\", \"{{@DN}}\"]], 12 at most");
  else
    for (const Value& one : *all) column(table, one, list);
  found_.parts_lists.push_back(std::move(list));
}

std::optional<BalloonSpec> NoteReader::balloons(TableReader& table) {
  const Value* const value = table.table("balloons");
  if (value == nullptr) return std::nullopt;
  TableReader inner(reading_, *value, "'balloons' of [[parts_list]]");
  BalloonSpec spec;
  spec.views = inner.texts("views");
  for (const std::string& name : spec.views)
    know_view(name, inner.at(), "'views' of " + inner.what());
  if (const auto size = inner.tolerance_mm("size")) {
    spec.diameter_mm = *size;
    if (!(*size >= 3 && *size <= 100))
      reading_.fault(inner.value("size")->at, "circles of this diameter hold no numbers to be read",
                     "write a diameter on paper from 3mm to 100mm");
  }
  constexpr std::array<std::string_view, 5> kSides{"anywhere", "left", "right", "top", "bottom"};
  const std::string side = inner.word("side", kSides).value_or("anywhere");
  spec.side = static_cast<BalloonSpec::Side>(std::ranges::find(kSides, side) - kSides.begin());
  return spec;
}

void NoteReader::column(TableReader& table, const Value& value, PartsListSpec& list) {
  const auto* const pair = std::get_if<Array>(&value.held);
  const bool two = pair != nullptr && pair->size() == 2;
  const auto* const heading = two ? std::get_if<std::string>(&pair->front().held) : nullptr;
  const auto* const text = two ? std::get_if<std::string>(&pair->back().held) : nullptr;
  if (heading == nullptr || text == nullptr) {
    reading_.fault(value.at,
                   "'columns' of " + table.what() + " has a column without heading or text",
                   "write columns = [[\"NAME\", \"{{name}}\"], [\"DN\", \"{{@DN}}\"]]");
    return;
  }
  const auto pieces = split_placeholders(*text);
  if (!pieces)
    reading_.fault(value.at, "'columns' of " + table.what() + ": " + pieces.error().message,
                   pieces.error().mend);
  for (std::size_t p = 0; pieces && p < pieces->size(); ++p)
    if (const std::string& name = (*pieces)[p].name; !name.empty() && !is_tag_name(name))
      reading_.fault(value.at, "'columns' of " + table.what() + " has {{" + name + "}}",
                     "write {{name}}, {{id}}, {{path}}, {{file}}, {{type}} or {{@ATTRIBUTE}}");
  list.headings.push_back(*heading);
  list.columns.push_back(*text);
}

void NoteReader::revision(const Value& value) {
  TableReader table(reading_, value, "[[revision]]");
  constexpr std::size_t kMaxRevisions = 100;
  if (found_.revisions.size() == kMaxRevisions)
    reading_.fault(value.at, "a sheet of more than 100 revisions", "keep those that matter");
  RevisionSpec revision;
  revision.revision = table.required_text("revision");
  revision.date = table.text("date").value_or("");
  revision.text = table.text("text").value_or("");
  revision.by = table.text("by").value_or("");
  found_.revisions.push_back(std::move(revision));
}

DimensionEnd NoteReader::end_of_dimension(TableReader& table, std::string_view key) {
  DimensionEnd end;
  const Value* const value = table.value(key);
  if (value == nullptr) {
    reading_.fault(table.at(), "[[dimension]] has no '" + std::string(key) + "'",
                   "write " + std::string(key) +
                       " = [\"1m\", \"0m\", \"2m\"], or { object = \"NAME\", " +
                       "side = \"left\" }");
    return end;
  }
  if (!std::holds_alternative<settings::Table>(value->held)) {
    const auto mm = table.point_mm(key);
    const auto point = mm ? geometry::snap(*mm) : std::nullopt;
    if (point)
      end.point = *point;
    else
      reading_.fault(value->at,
                     "'" + std::string(key) + "' of [[dimension]] is no point of the model",
                     "write " + std::string(key) + " = [\"1m\", \"0m\", \"2m\"]");
    return end;
  }
  TableReader inner(reading_, *value, "'" + std::string(key) + "' of [[dimension]]");
  end.object = inner.required_text("object");
  constexpr std::array<std::string_view, 5> kSides{"left", "right", "top", "bottom", "centre"};
  const std::string side = inner.word("side", kSides).value_or("centre");
  end.side = static_cast<DimensionEnd::Side>(std::ranges::find(kSides, side) - kSides.begin());
  return end;
}

void NoteReader::dimension(const Value& value) {
  TableReader table(reading_, value, "[[dimension]]");
  DimensionSpec spec;
  spec.where = place(value, "[[dimension]]");
  spec.view = table.required_text("view");
  know_view(spec.view, table.at(), "'view' of [[dimension]]");
  spec.from = end_of_dimension(table, "from");
  spec.to = end_of_dimension(table, "to");
  constexpr std::array<std::string_view, 3> kAlong{"horizontal", "vertical", "aligned"};
  const std::string along = table.word("along", kAlong).value_or("horizontal");
  spec.along = static_cast<DimensionSpec::Along>(std::ranges::find(kAlong, along) - kAlong.begin());
  constexpr std::array<std::string_view, 4> kPlaces{"above", "left", "below", "right"};
  const auto where = table.word("place", kPlaces);
  if (where) {
    const bool upright = *where == "left" || *where == "right";
    if (upright != (along == "vertical"))
      reading_.fault(table.value("place")->at, "'place' of [[dimension]] does not go with 'along'",
                     "write above or below for horizontal and aligned ones, left or right for "
                     "vertical ones");
    spec.other_side = *where == "below" || *where == "right";
  }
  if (const auto offset = table.tolerance_mm("offset")) spec.offset_mm = *offset;
  if (spec.offset_mm > 1000)
    reading_.fault(table.value("offset")->at, "'offset' of [[dimension]] is wider than any sheet",
                   "write a length of paper, as \"12mm\"");
  if (const auto decimals = table.whole("decimals")) {
    if (*decimals < 0 || *decimals > 3)
      reading_.fault(table.value("decimals")->at,
                     "the model is exact to three decimals of a millimetre",
                     "write decimals = 0 to 3");
    else
      spec.decimals = static_cast<int>(*decimals);
  }
  found_.dimensions.push_back(std::move(spec));
}

}  // namespace strake::sheets
