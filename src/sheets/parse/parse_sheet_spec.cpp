// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/number.hpp"
#include "core/text_encoding.hpp"
#include "core/units.hpp"
#include "drawing/layout/view_plane.hpp"
#include "drawing/layout/view_title.hpp"
#include "settings/table_reader.hpp"
#include "sheets/arrangement/neighbours.hpp"
#include "sheets/arrangement/view_arrangement.hpp"
#include "sheets/parse/note_reader.hpp"
#include "sheets/parse/paper_reader.hpp"
#include "sheets/parse/style_reader.hpp"
#include "sheets/parse/table_readers.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "strake/drawing/view.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::sheets {

namespace {

using settings::KeyValue;
using settings::NamedSets;
using settings::ParseContext;
using settings::SourcePosition;
using settings::TableReader;
using settings::Value;

constexpr double kFarthestPositionMm = 1e6;
constexpr std::size_t kMaxViews = 100, kMaxSheets = 100, kMaxFields = 1000;

struct SlotName {
  std::string_view name;
  ViewSlot slot;
  std::string_view title;
};
constexpr std::array<SlotName, 7> kSlots{{{"front", ViewSlot::front, "FRONT VIEW"},
                                          {"top", ViewSlot::top, "TOP VIEW"},
                                          {"bottom", ViewSlot::bottom, "BOTTOM VIEW"},
                                          {"left", ViewSlot::left, "LEFT VIEW"},
                                          {"right", ViewSlot::right, "RIGHT VIEW"},
                                          {"back", ViewSlot::back, "REAR VIEW"},
                                          {"iso", ViewSlot::iso, "ISOMETRIC VIEW"}}};
constexpr std::array<std::string_view, 2> kProjections{"first-angle", "third-angle"};

/// Reads the tables of a sheet one by one. An error is kept by the parse context, and what is read
/// after it is thrown away with the rest.
class SheetParser {
 public:
  /// `top` has the tables: the file, or a [[sheet]] of it.
  SheetParser(ParseContext& reading, TableReader& top, NamedSets& sets, ReadTemplate read_template)
      : reading_(reading),
        top_(top),
        sets_(sets),
        views_(reading, sets_),
        paper_(reading, read_template, found_) {
    found_.file = reading.file();
  }

  /// Reads the sheet of a file that describes one.
  SheetSpec run() {
    if (const Value* const value = top_.table("sheet")) {
      TableReader table(reading_, *value, "[sheet]");
      paper_.read(table);
    }
    fields();
    defaults();
    views_and_marks();
    return std::move(found_);
  }

  /// Reads what the sheets of a file have in common, each of which begins as a copy of this.
  void read_common() {
    fields();
    defaults();
    styles();
  }

  /// Reads a [[sheet]].
  SheetSpec run_as(const std::string& name) {
    found_.name = name;
    paper_.read(top_);
    fields();
    defaults();
    views_and_marks();
    return std::move(found_);
  }

  /// Begins with what another has read.
  void begin_with(const SheetParser& common) {
    found_ = common.found_;
    defaults_ = common.defaults_;
  }

 private:
  void defaults() {
    const Value* const value = top_.table("defaults");
    if (value == nullptr) return;
    TableReader table(reading_, *value, "[defaults]");
    views_.content(table, defaults_);
    defaults_.match_lines_own = false;
  }

  void styles() {
    MarkReader marks(reading_, sets_, found_);
    if (const Value* const value = top_.table("styles")) marks.styles(*value);
    // What a sheet says itself comes before what it has in common with others.
    std::vector<ObjectStyleSpec> common = std::exchange(found_.object_styles, {});
    for (const Value* value : top_.tables("style"))
      found_.object_styles.push_back(read_object_style(reading_, sets_, *value));
    std::ranges::move(common, std::back_inserter(found_.object_styles));
    if (found_.object_styles.size() > drawing::kMaxObjectStyles)
      reading_.fault(top_.at(), "a sheet of more than 1000 styles", "keep those that are seen");
  }

  void views_and_marks() {
    arrangement();
    for (const Value* value : top_.tables("view")) view(*value);
    if (found_.views.size() > kMaxViews)
      reading_.fault({1, 1}, "a sheet of more than 100 views", "make several sheets of it");
    check_positions();
    for (ViewSpec& view : found_.views) views_.place_sections(view);
    name_sections();
    MarkReader marks(reading_, sets_, found_);
    for (const Value* value : top_.tables("tag")) marks.tag(*value);
    if (const Value* const value = top_.table("grid")) marks.grid(*value);
    styles();
    NoteReader notes(reading_, sets_, found_);
    if (const Value* const value = top_.table("levels")) notes.levels(*value);
    if (const Value* const value = top_.table("scale_bar")) notes.scale_bar(*value);
    if (const Value* const value = top_.table("north")) notes.north(*value);
    for (const Value* value : top_.tables("parts_list")) notes.parts_list(*value);
    for (const Value* value : top_.tables("revision")) notes.revision(*value);
    for (const Value* value : top_.tables("dimension")) notes.dimension(*value);
    for (std::size_t v = 0; v < found_.views.size(); ++v)
      notes.check_names(found_.views[v], places_[v]);
  }

  void fields() {
    const Value* const value = top_.table("fields");
    if (value == nullptr) return;
    TableReader table(reading_, *value, "[fields]");
    found_.fields_where =
        reading_.file() + ", line " + std::to_string(value->at.line) + ": [fields]";
    const std::vector<const KeyValue*> entries = table.others();
    if (entries.size() > kMaxFields) {
      reading_.fault(value->at, "a sheet of more than 1000 fields",
                     "keep those that its title block shows");
      return;
    }
    for (const KeyValue* entry : entries) {
      const auto* const text = std::get_if<std::string>(&entry->value.held);
      const auto* const whole = std::get_if<std::int64_t>(&entry->value.held);
      if (text == nullptr && whole == nullptr)
        reading_.fault(entry->value.at, "the field '" + entry->key + "' is no text",
                       "write " + entry->key + " = \"...\"");
      else
        set_field(entry->key, text != nullptr ? *text : std::to_string(*whole));
    }
  }

  /// Sets a field, which all sheets may have in common with another value.
  void set_field(const std::string& name, const std::string& value) {
    for (auto& field : found_.fields)
      if (field.first == name) {
        field.second = value;
        return;
      }
    found_.fields.emplace_back(name, value);
  }

  void arrangement() {
    const Value* const value = top_.value("arrangement");
    if (value == nullptr) return;
    ViewSpec front = defaults_;
    front.view.direction = {0, -1, 0};
    if (const auto* const word = std::get_if<std::string>(&value->held)) {
      if (std::find(kProjections.begin(), kProjections.end(), *word) == kProjections.end())
        reading_.fault(value->at, "'arrangement' is '" + *word + "'",
                       "write \"first-angle\" or \"third-angle\", or a table [arrangement]");
      project(*word);
      arrange_views(nullptr, usual_views(), front);
      return;
    }
    TableReader table(reading_, *value, "[arrangement]");
    project(table.word("projection", kProjections).value_or("first-angle"));
    views_.direction(table, front);
    check_axes(table, front.view);
    if (const auto scale = ViewReader::scale(table)) found_.scale = scale;
    if (const auto gap = table.tolerance_mm("gap")) {
      found_.gap_mm = *gap;
      if (*gap > 1000)
        reading_.fault(table.value("gap")->at, "'gap' of [arrangement] is wider than any sheet",
                       "write a length of paper, as \"20mm\"");
    }
    views_.content(table, front);
    front.match_lines_own = false;
    std::vector<std::string> names = table.texts("views");
    if (names.empty()) names = usual_views();
    arrange_views(&table, names, front);
  }

  void project(const std::string& word) {
    found_.projection = word == "third-angle" ? Projection::third_angle : Projection::first_angle;
  }

  [[nodiscard]] std::vector<std::string> usual_views() const {
    return {"top", found_.projection == Projection::third_angle ? "right" : "left", "iso"};
  }

  void check_axes(TableReader& table, const hlr::View& front) {
    const auto along_axis = [](const geometry::Vec3l& v) {
      return std::abs(v.x) + std::abs(v.y) + std::abs(v.z) == 1;
    };
    if (!along_axis(front.direction) || !along_axis(front.up) ||
        dot(front.direction, front.up) != 0)
      reading_.fault(
          table.at(), "the front view of [arrangement] does not look along an axis",
          "write direction = \"front\", \"left\", \"top\" and so on, and an axis for up; "
          "other directions are for [[view]]");
  }

  void arrange_views(TableReader* table, std::vector<std::string> names, const ViewSpec& front) {
    const SourcePosition at = table != nullptr ? table->at() : SourcePosition{1, 1};
    if (std::find(names.begin(), names.end(), "front") == names.end())
      names.insert(names.begin(), "front");
    for (std::size_t n = 0; n < names.size(); ++n) {
      const auto known = std::find_if(kSlots.begin(), kSlots.end(),
                                      [&](const SlotName& s) { return s.name == names[n]; });
      if (known == kSlots.end()) {
        reading_.fault(at, "'views' of [arrangement] names '" + names[n] + "'",
                       "its views are front, top, bottom, left, right, back and iso");
        return;
      }
      ViewSpec view = front;
      view.slot = known->slot;
      view.title = known->title;
      view.name = names[n];
      view.view = view_in_slot(known->slot, front.view);
      claim(view.name, at);
      view.where = place(at) + ": [arrangement], '" + view.name + "'";
      add(std::move(view), at);
    }
    for (const SlotName& slot : kSlots)
      if (table != nullptr) alter(*table, slot);
  }

  /// Reads [arrangement.top] and the like: the deviations of one of its views.
  void alter(TableReader& arrangement, const SlotName& slot) {
    const Value* const value = arrangement.table(slot.name);
    if (value == nullptr) return;
    const std::string what = "[arrangement." + std::string(slot.name) + "]";
    const auto view = std::find_if(found_.views.begin(), found_.views.end(),
                                   [&](const ViewSpec& v) { return v.slot == slot.slot; });
    if (view == found_.views.end()) {
      reading_.fault(value->at, what + " is about a view that is not arranged",
                     "name \"" + std::string(slot.name) + "\" in views");
      return;
    }
    TableReader table(reading_, *value, what);
    view->where = place(value->at) + ": " + what;
    if (const auto title = table.text("title")) entitle(*view, *title);
    view_marks(table, *view);
    views_.content(table, *view);
  }

  /// Reads what a view says of others.
  void view_marks(TableReader& table, ViewSpec& view) {
    if (const auto mark = table.text("section_mark")) {
      view.section_mark = on_one_line(*mark);
      constexpr std::size_t kLongestMark = 8;
      if (mark->empty() || mark->size() > kLongestMark)
        reading_.fault(table.value("section_mark")->at,
                       "'section_mark' of " + table.what() + " is no letter",
                       "write section_mark = \"A\"");
    }
    view.extents_of = table.texts("extents_of");
  }

  void view(const Value& value) {
    TableReader table(reading_, value, "[[view]]");
    ViewSpec view = defaults_;
    view.name = table.required_text("name");
    claim(view.name, table.at());
    table.call(view.name);
    view.where = place(value.at) + ": " + table.what();
    view.title = view.name;
    if (const auto title = table.text("title")) entitle(view, *title);
    views_.read_perspective(table, view);
    view_marks(table, view);
    view.scale = ViewReader::scale(table);
    if (const auto at = table.lengths_mm("position", 2, "[\"150mm\", \"120mm\"]"))
      view.position = PaperPoint{(*at)[0], (*at)[1]};
    if (view.position && !(std::fabs(view.position->x) <= kFarthestPositionMm &&
                           std::fabs(view.position->y) <= kFarthestPositionMm))
      reading_.fault(value.at, "'position' of " + table.what() + " is far off any sheet",
                     "write millimetres of paper from the upper left corner");
    view.anchor = views_.point(table, "anchor");
    if (view.anchor && !is_in_view(*view.anchor, view.view))
      reading_.fault(table.value("anchor")->at,
                     "'anchor' of " + table.what() +
                         " lies behind the eye, or nearer to it than what is drawn",
                     "write a point farther before it, the target, say");
    views_.content(table, view);
    add(std::move(view), value.at);
  }

  /// Returns whether a point has a place on paper: it is not behind the eye, nor before the near
  /// plane.
  static bool is_in_view(const geometry::Vec3l& point, const hlr::View& view) {
    const auto axes = drawing::paper_axes(view);
    if (!axes || !axes->eye) return true;
    return dot(axes->toward, geometry::to_mm(axes->eye->at - point)) >= axes->eye->near_mm;
  }

  static void entitle(ViewSpec& view, const std::string& title) {
    view.title = title;
    view.own_title = true;
  }

  /// Has the views that the file gives no title say which sections they are.
  void name_sections() {
    for (ViewSpec& view : found_.views) {
      if (view.own_title) continue;
      const std::string& mark = view.section_mark;
      view.title =
          mark.empty() ? drawing::title_of(view.title, view.view) : "SECTION " + mark + "-" + mark;
    }
  }

  void add(ViewSpec view, SourcePosition at) {
    found_.views.push_back(std::move(view));
    places_.push_back(at);
  }

  void check_positions() {
    for (std::size_t v = 0; v < found_.views.size(); ++v)
      if (const ViewSpec& view = found_.views[v];
          view.slot == ViewSlot::none && !view.position && found_.views.size() > 1)
        reading_.fault(places_[v], "the view '" + view.name + "' has no place on the sheet",
                       "write position = [\"150mm\", \"120mm\"] in its table");
  }

  void claim(const std::string& name, SourcePosition at) {
    for (const ViewSpec& view : found_.views)
      if (view.name == name)
        reading_.fault(at, "the name '" + name + "' is given to two views", "give each its own");
  }

  [[nodiscard]] std::string place(SourcePosition at) const {
    return reading_.file() + ", line " + std::to_string(at.line);
  }

  ParseContext& reading_;
  TableReader& top_;
  NamedSets& sets_;
  ViewReader views_;
  PaperReader paper_;
  ViewSpec defaults_;
  SheetSpec found_;
  std::vector<SourcePosition> places_;  ///< positions of the views in the file
};

/// Reads the [[sheet]] tables of a file, and before them what they have in common.
class SheetSetParser {
 public:
  SheetSetParser(ParseContext& reading, TableReader& top, NamedSets& sets,
                 ReadTemplate read_template)
      : reading_(reading), top_(top), sets_(sets), read_template_(read_template) {}

  std::vector<SheetSpec> run(const settings::Array& sheets) {
    SheetParser common(reading_, top_, sets_, read_template_);
    common.read_common();
    refuse_what_sheets_have();
    std::vector<SheetSpec> found;
    if (sheets.size() > kMaxSheets) {
      reading_.fault(top_.value("sheet")->at, "a file of more than 100 sheets",
                     "make several files of it");
      return found;
    }
    for (const Value& value : sheets) {
      found.push_back(sheet(value, common, found));
      if (found.back().views.empty())
        reading_.fault(value.at, "the sheet '" + found.back().name + "' has no views",
                       "write arrangement = \"first-angle\" below its [[sheet]], or "
                       "[[sheet.view]] tables");
    }
    for (std::size_t s = 0; s < found.size(); ++s) {
      found[s].number = s + 1;
      found[s].of = found.size();
    }
    return found;
  }

 private:
  /// Tables of views and notes belong to a sheet, and nobody knows to which.
  void refuse_what_sheets_have() {
    for (const std::string_view key : {"arrangement", "view", "tag", "grid", "levels", "scale_bar",
                                       "north", "parts_list", "revision", "dimension"})
      if (const Value* const value = top_.value(key))
        reading_.fault(value->at,
                       "'" + std::string(key) + "' stands beside [[sheet]], and belongs to one",
                       "write sheet." + std::string(key) + " below its [[sheet]]");
  }

  SheetSpec sheet(const Value& value, const SheetParser& common,
                  const std::vector<SheetSpec>& before) {
    TableReader table(reading_, value, "[[sheet]]");
    const std::string name = name_of(table, before);
    SheetParser parser(reading_, table, sets_, read_template_);
    parser.begin_with(common);
    return parser.run_as(name);
  }

  std::string name_of(TableReader& table, const std::vector<SheetSpec>& before) {
    const std::string name = table.required_text("name");
    table.call(name);
    const Value* const value = table.value("name");
    if (value != nullptr && !is_part_of_a_file_name(name))
      reading_.fault(value->at, "'name' of [[sheet]] cannot be part of the name of a file",
                     "give it up to 100 letters, digits, spaces, '-', '_' and '.'");
    for (const SheetSpec& other : before)
      if (other.name == name)
        reading_.fault(table.at(), "the name '" + name + "' is given to two sheets",
                       "give each its own");
    return name;
  }

  static bool is_part_of_a_file_name(std::string_view name) {
    constexpr std::size_t kLongestName = 100;
    if (name.empty() || name.size() > kLongestName) return false;
    // As the name of a folder these would be that of another one.
    if (name == "." || name == "..") return false;
    while (!name.empty()) {
      const DecodedCharacter c = decode_character(name);
      if (!is_printable(c) || std::string_view("/\\:*?\"<>|{}").find(c.bytes) != std::string::npos)
        return false;
    }
    return true;
  }

  ParseContext& reading_;
  TableReader& top_;
  NamedSets& sets_;
  ReadTemplate read_template_;
};

std::vector<SheetSpec> read_document(ParseContext& reading, const Value& document,
                                     ReadTemplate read_template) {
  // As they end, readers of tables refuse keys that were not read.
  TableReader top(reading, document, "the file");
  NamedSets sets(reading, top.table("sets"));
  (void)sets.all();  // sets that nothing names may be wrong as well
  const Value* const sheet = top.value("sheet");
  const auto* const several =
      sheet != nullptr ? std::get_if<settings::Array>(&sheet->held) : nullptr;
  if (several != nullptr) return SheetSetParser(reading, top, sets, read_template).run(*several);
  std::vector<SheetSpec> one;
  one.push_back(SheetParser(reading, top, sets, read_template).run());
  return one;
}

}  // namespace

Result<std::vector<SheetSpec>> parse_sheet_specs(std::string_view text, std::string_view file,
                                                 ReadTemplate read_template) {
  const Result<Value> document = settings::parse_toml(text, file);
  if (!document) return document.error();
  ParseContext reading{std::string(file)};
  std::vector<SheetSpec> found = read_document(reading, *document, read_template);
  if (found.empty()) reading.fault({1, 1}, "the file has no sheets", "write [[sheet]] tables");
  if (found.size() == 1 && found.front().name.empty() && found.front().views.empty())
    reading.fault({1, 1}, "the sheet has no views",
                  "write arrangement = \"first-angle\" at the top, or [[view]] tables");
  if (!reading.good()) return reading.error();
  find_neighbours(found);
  return found;
}

}  // namespace strake::sheets
