// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "core/number.hpp"
#include "core/units.hpp"
#include "drawing/layout/paper_size.hpp"
#include "drawing/layout/view_plane.hpp"
#include "drawing/layout/view_title.hpp"
#include "settings/table_reader.hpp"
#include "sheets/arrangement/view_arrangement.hpp"
#include "sheets/parse/note_reader.hpp"
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

constexpr double kFarthestMm = 1e6;
constexpr std::size_t kMostViews = 100;

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

/// Reads the tables of a file one by one. An error is kept by the parse context, and what is read
/// after it is thrown away with the rest.
class Parser {
 public:
  Parser(ParseContext& reading, const Value& document, ReadTemplate read_template)
      : reading_(reading),
        read_template_(read_template),
        top_(reading, document, "the file"),
        sets_(reading, top_.table("sets")),
        views_(reading, sets_) {
    found_.file = reading.file();
  }

  SheetSpec run() {
    sheet();
    fields();
    (void)sets_.all();  // sets that nothing names may be wrong as well
    if (const Value* const value = top_.table("defaults")) {
      TableReader table(reading_, *value, "[defaults]");
      views_.content(table, defaults_);
    }
    arrangement();
    for (const Value* value : top_.tables("view")) view(*value);
    if (found_.views.size() > kMostViews)
      reading_.fault({1, 1}, "a sheet of more than 100 views", "make several sheets of it");
    check_positions();
    for (ViewSpec& view : found_.views) views_.place_sections(view);
    name_sections();
    MarkReader marks(reading_, sets_, found_);
    for (const Value* value : top_.tables("tag")) marks.tag(*value);
    if (const Value* const value = top_.table("grid")) marks.grid(*value);
    if (const Value* const value = top_.table("styles")) marks.styles(*value);
    NoteReader notes(reading_, sets_, found_);
    if (const Value* const value = top_.table("levels")) notes.levels(*value);
    if (const Value* const value = top_.table("scale_bar")) notes.scale_bar(*value);
    if (const Value* const value = top_.table("north")) notes.north(*value);
    for (const Value* value : top_.tables("parts_list")) notes.parts_list(*value);
    for (const Value* value : top_.tables("revision")) notes.revision(*value);
    for (const Value* value : top_.tables("dimension")) notes.dimension(*value);
    for (std::size_t v = 0; v < found_.views.size(); ++v)
      notes.check_names(found_.views[v], places_[v]);
    return std::move(found_);
  }

 private:
  void sheet() {
    const Value* const value = top_.table("sheet");
    if (value == nullptr) return;
    TableReader table(reading_, *value, "[sheet]");
    artwork(table);
    size(table);
    found_.frame = table.flag("frame").value_or(true);
    found_.scale = ViewReader::scale(table);
    constexpr std::array<std::string_view, 2> kHiddenLayers{"one", "two"};
    found_.split_hidden = table.word("hidden_layers", kHiddenLayers).value_or("one") == "two";
    constexpr std::string_view kBox = "[\"20mm\", \"10mm\", \"410mm\", \"230mm\"]";
    if (const auto box = table.lengths_mm("area", 4, kBox))
      found_.area = paper_box(table, "area", *box);
    keep_free(table);
  }

  PaperBox paper_box(TableReader& table, std::string_view key, const std::vector<double>& sides) {
    const PaperBox box{sides[0], sides[1], sides[2], sides[3]};
    const bool near = std::all_of(sides.begin(), sides.end(),
                                  [](double mm) { return std::fabs(mm) <= kFarthestMm; });
    if (!near || !(box.width() > 0 && box.height() > 0))
      reading_.fault(table.value(key)->at,
                     "'" + std::string(key) + "' of [sheet] is no box of paper",
                     "write left, top, right, bottom, from the upper left corner of the sheet");
    return box;
  }

  void keep_free(TableReader& table) {
    const Value* const value = table.value("keep_free");
    if (value == nullptr) return;
    const std::string mend = "write keep_free = [[\"230mm\", \"240mm\", \"410mm\", \"287mm\"]]";
    const auto* const list = std::get_if<settings::Array>(&value->held);
    if (list == nullptr) {
      reading_.fault(value->at, "'keep_free' of [sheet] is no list of boxes", mend);
      return;
    }
    for (const Value& box : *list) {
      const auto* const sides = std::get_if<settings::Array>(&box.held);
      if (sides == nullptr || sides->size() != 4) {
        reading_.fault(box.at, "'keep_free' of [sheet] has something that is no box", mend);
        return;
      }
      std::vector<double> lengths;
      for (const Value& side : *sides)
        lengths.push_back(table.length_mm(side, "keep_free").value_or(0));
      found_.keep_free.push_back(paper_box(table, "keep_free", lengths));
    }
  }

  void artwork(TableReader& table) {
    const auto name = table.text("template");
    if (!name) return;
    const SourcePosition at = table.value("template")->at;
    const Result<std::string> text = read_template_(*name);
    if (!text) {
      const Error& error = text.error();
      reading_.fault(at, "the template '" + *name + "' " + error.message, error.mend);
      return;
    }
    Result<Template> parsed = parse_template(*text);
    if (!parsed) {
      Error error = parsed.error();
      error.where = *name + ", " + error.where + " (the template of " + reading_.file() + ")";
      reading_.fault(std::move(error));
      return;
    }
    found_.artwork = std::move(*parsed);
    found_.template_name = *name;
  }

  void size(TableReader& table) {
    const Value* const value = table.value("size");
    constexpr std::array<std::string_view, 2> kTextWays{"landscape", "portrait"};
    const auto orientation = table.word("orientation", kTextWays);
    const auto* const name = value != nullptr ? std::get_if<std::string>(&value->held) : nullptr;
    const bool standard = value == nullptr || name != nullptr;
    if (orientation && !standard)
      reading_.fault(table.at(), "'orientation' of [sheet] goes with the sizes A4 to A0",
                     "write the width before the height in size");
    if (value == nullptr && found_.artwork && !orientation) {
      take_size(found_.artwork->width_mm, found_.artwork->height_mm);
    } else if (standard) {
      named_size(table, name != nullptr ? *name : "A3", orientation == "portrait");
    } else if (const auto sides =
                   table.lengths_mm("size", 2, "\"A3\", or [\"600mm\", \"300mm\"]")) {
      take_size((*sides)[0], (*sides)[1]);
    }
    const auto allowed = [](double mm) {
      return mm >= drawing::kLeastPaperMm && mm <= drawing::kLargestPaperMm;
    };
    if (!allowed(found_.width_mm) || !allowed(found_.height_mm))
      reading_.fault(value != nullptr ? value->at : table.at(), "a sheet of " + found_.size + " mm",
                     "take 100mm to 20m");
    check_artwork(table);
  }

  void take_size(double width_mm, double height_mm) {
    const double width = drawing::rounded_paper(width_mm);
    const double height = drawing::rounded_paper(height_mm);
    found_.width_mm = width;
    found_.height_mm = height;
    found_.size = shortest(width) + " x " + shortest(height);
    for (const auto& [name, size] : drawing::kNamedPapers)
      if (std::max(width, height) == size.width_mm && std::min(width, height) == size.height_mm)
        found_.size = name;
  }

  void named_size(TableReader& table, const std::string& name, bool portrait) {
    for (const auto& [known, size] : drawing::kNamedPapers)
      if (known == name)
        return take_size(portrait ? size.height_mm : size.width_mm,
                         portrait ? size.width_mm : size.height_mm);
    reading_.fault(
        table.value("size")->at, "no sheet is called '" + name + "'",
        "write size = \"A4\", \"A3\", \"A2\", \"A1\" or \"A0\", or [\"600mm\", \"300mm\"]");
  }

  void check_artwork(TableReader& table) {
    if (!found_.artwork) return;
    const auto near = [](double a, double b) { return std::fabs(a - b) <= 0.5; };
    if (!near(found_.width_mm, found_.artwork->width_mm) ||
        !near(found_.height_mm, found_.artwork->height_mm))
      reading_.fault(table.at(),
                     "the template is " + shortest(found_.artwork->width_mm) + " x " +
                         shortest(found_.artwork->height_mm) + " mm, the sheet " +
                         shortest(found_.width_mm) + " x " + shortest(found_.height_mm),
                     "give the sheet the size of its template, or leave size out");
  }

  void fields() {
    const Value* const value = top_.table("fields");
    if (value == nullptr) return;
    TableReader table(reading_, *value, "[fields]");
    found_.fields_where =
        reading_.file() + ", line " + std::to_string(value->at.line) + ": [fields]";
    for (const KeyValue* entry : table.others()) {
      const auto* const text = std::get_if<std::string>(&entry->value.held);
      const auto* const whole = std::get_if<std::int64_t>(&entry->value.held);
      if (text == nullptr && whole == nullptr)
        reading_.fault(entry->value.at, "the field '" + entry->key + "' is no text",
                       "write " + entry->key + " = \"...\"");
      else
        found_.fields.emplace_back(entry->key, text != nullptr ? *text : std::to_string(*whole));
    }
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
    views_.seen_from(table, view);
    view_marks(table, view);
    view.scale = ViewReader::scale(table);
    if (const auto at = table.lengths_mm("position", 2, "[\"150mm\", \"120mm\"]"))
      view.position = PaperPoint{(*at)[0], (*at)[1]};
    if (view.position &&
        !(std::fabs(view.position->x) <= kFarthestMm && std::fabs(view.position->y) <= kFarthestMm))
      reading_.fault(value.at, "'position' of " + table.what() + " is far off any sheet",
                     "write millimetres of paper from the upper left corner");
    view.anchor = views_.point(table, "anchor");
    if (view.anchor && !can_be_seen(*view.anchor, view.view))
      reading_.fault(table.value("anchor")->at,
                     "'anchor' of " + table.what() +
                         " lies behind the eye, or nearer to it than what is drawn",
                     "write a point farther before it, the target, say");
    views_.content(table, view);
    add(std::move(view), value.at);
  }

  /// Returns whether a point has a place on paper: it is not behind the eye, nor before the near
  /// plane.
  static bool can_be_seen(const geometry::Vec3l& point, const hlr::View& view) {
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
  ReadTemplate read_template_;
  TableReader top_;
  NamedSets sets_;
  ViewReader views_;
  ViewSpec defaults_;
  SheetSpec found_;
  std::vector<SourcePosition> places_;  ///< positions of the views in the file
};

}  // namespace

Result<SheetSpec> parse_sheet_spec(std::string_view text, std::string_view file,
                                   ReadTemplate read_template) {
  const Result<Value> document = settings::parse_toml(text, file);
  if (!document) return document.error();
  ParseContext reading{std::string(file)};
  SheetSpec found;
  {
    Parser parser(reading, *document, read_template);
    found = parser.run();
  }  // as it ends, the parser refuses keys that were not read
  if (found.views.empty())
    reading.fault({1, 1}, "the sheet has no views",
                  "write arrangement = \"first-angle\" at the top, or [[view]] tables");
  if (!reading.good()) return reading.error();
  return found;
}

}  // namespace strake::sheets
