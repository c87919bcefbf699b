// SPDX-License-Identifier: Apache-2.0
// The built-in frame and title block, and the fields of a sheet.
#include "sheets/annotation/title_block.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "drawing/layout/view_plane.hpp"
#include "sheets/spec/text_metrics.hpp"
#include "strake/drawing/write.hpp"

namespace strake::sheets {

namespace {

using drawing::rounded_paper;

constexpr double kBinding = 20, kMargin = 10, kBand = 5, kInset = 4;
constexpr double kBlockWidth = 180, kBlockHeight = 48;
constexpr double kSmallest = 1.5;                      ///< the smallest legible letters
constexpr std::string_view kNoScale = "\xE2\x80\x93";  ///< a dash: nothing can be measured

PaperBox border_of(const SheetSpec& sheet) {
  return {kBinding, kMargin, sheet.width_mm - kMargin, sheet.height_mm - kMargin};
}

PaperBox block_of(const SheetSpec& sheet) {
  const PaperBox border = border_of(sheet);
  const double scale =
      std::min({1.0, border.width() / kBlockWidth, border.height() / 2 / kBlockHeight});
  return {border.right - kBlockWidth * scale, border.bottom - kBlockHeight * scale, border.right,
          border.bottom};
}

Path rectangle(LineClass line, const PaperBox& b) {
  return {
      line,
      {{b.left, b.top}, {b.right, b.top}, {b.right, b.bottom}, {b.left, b.bottom}, {b.left, b.top}},
      false};
}

/// Returns "A" to "Z" without I and O, then "AA".
std::string zone_letter(std::size_t zone) {
  constexpr std::string_view kLetters = "ABCDEFGHJKLMNPQRSTUVWXYZ";
  const std::string last(1, kLetters[zone % kLetters.size()]);
  return zone < kLetters.size() ? last : zone_letter(zone / kLetters.size() - 1) + last;
}

/// Centring marks, and the reference fields between the border and a line 5 mm outside of it, about
/// 50 mm each, an even number of them so that the middle is a boundary.
class Zones {
 public:
  Zones(const PaperBox& border, const PaperBox& block, Marks& marks)
      : border_(border), block_(block), marks_(marks) {}

  void draw() {
    const PaperBox outer{border_.left - kBand, border_.top - kBand, border_.right + kBand,
                         border_.bottom + kBand};
    marks_.paths.push_back(rectangle(LineClass::frame_thin, outer));
    const std::size_t columns = count(border_.width()), rows = count(border_.height());
    for (std::size_t c = 0; c < columns; ++c) {
      const double x =
          border_.left + border_.width() * static_cast<double>(c) / static_cast<double>(columns);
      const double middle = border_.left + border_.width() * (static_cast<double>(c) + 0.5) /
                                               static_cast<double>(columns);
      if (c > 0) {
        tick({x, outer.top}, {x, border_.top});
        tick({x, border_.bottom}, {x, outer.bottom});
      }
      letter(std::to_string(c + 1), middle, border_.top - kBand / 2);
      letter(std::to_string(c + 1), middle, border_.bottom + kBand / 2);
    }
    for (std::size_t r = 0; r < rows; ++r) {
      const double y =
          border_.top + border_.height() * static_cast<double>(r) / static_cast<double>(rows);
      const double middle = border_.top + border_.height() * (static_cast<double>(r) + 0.5) /
                                              static_cast<double>(rows);
      if (r > 0) {
        tick({outer.left, y}, {border_.left, y});
        tick({border_.right, y}, {outer.right, y});
      }
      letter(zone_letter(r), border_.left - kBand / 2, middle);
      letter(zone_letter(r), border_.right + kBand / 2, middle);
    }
    center_marks(outer);
  }

 private:
  static std::size_t count(double length) {
    return 2 * static_cast<std::size_t>(std::max(1.0, std::round(length / 100)));
  }

  void tick(PaperPoint a, PaperPoint b) {
    for (PaperPoint* p : {&a, &b}) *p = {rounded_paper(p->x), rounded_paper(p->y)};
    marks_.paths.push_back({LineClass::frame_thin, {a, b}, false});
  }

  void letter(const std::string& text, double x, double y) {
    constexpr double kHeight = 2.5;
    marks_.texts.push_back({LineClass::frame_thin,
                            {rounded_paper(x), rounded_paper(y + kHeight / 2)},
                            kHeight,
                            Align::middle,
                            text,
                            false});
  }

  void center_marks(const PaperBox& outer) {
    const double x = rounded_paper((border_.left + border_.right) / 2);
    const double y = rounded_paper((border_.top + border_.bottom) / 2);
    const auto mark = [&](const PaperPoint& a, const PaperPoint& b) {
      marks_.paths.push_back({LineClass::frame, {a, b}, false});
    };
    mark({x, outer.top}, {x, border_.top + kInset});
    // The mark does not enter the title block, which on small sheets is as wide as they are.
    mark({x, block_.left < x ? border_.bottom : border_.bottom - kInset}, {x, outer.bottom});
    mark({outer.left, y}, {border_.left + kInset, y});
    mark({block_.top < y ? border_.right : border_.right - kInset, y}, {outer.right, y});
  }

  const PaperBox &border_, &block_;
  Marks& marks_;
};

/// A cell of the title block: millimetres from its upper left corner, at its full size.
struct TitleField {
  std::string_view name, label;
  double left, top, width, height, letters;
};
constexpr std::array<TitleField, 12> kFields{{{"drawn", "DRAWN", 0, 0, 58, 9, 3},
                                              {"checked", "CHECKED", 0, 9, 58, 9, 3},
                                              {"approved", "APPROVED", 0, 18, 58, 9, 3},
                                              {"date", "DATE", 0, 27, 58, 9, 3},
                                              {"owner", "OWNER", 58, 0, 122, 11, 4},
                                              {"title", "TITLE", 58, 11, 122, 14, 5},
                                              {"subtitle", "", 58, 25, 122, 11, 3.5},
                                              {"scale", "SCALE", 0, 36, 34, 12, 3.5},
                                              {"size", "SIZE", 34, 36, 24, 12, 3.5},
                                              {"number", "DRAWING NUMBER", 82, 36, 62, 12, 5},
                                              {"revision", "REV", 144, 36, 16, 12, 5},
                                              {"sheet", "SHEET", 160, 36, 20, 12, 3.5}}};
constexpr PaperBox kSymbol{58, 36, 82, 48};

class TitleBlock {
 public:
  TitleBlock(const PaperBox& block, Marks& marks)
      : block_(block), scale_(block.width() / kBlockWidth), marks_(marks) {}

  void draw(Lookup field, std::vector<std::string>* narrow) {
    for (const TitleField& cell : kFields) {
      // A field without a label shares the box of the one above.
      if (!cell.label.empty()) box_of_cell(cell);
      if (!cell.label.empty()) text(cell.label, cell.left + 1, cell.top + 2.6, 1.8, Align::start);
      const std::string value = field(std::string(cell.name));
      if (value.empty()) continue;
      Text line = placed(value, cell.left + 2.5, cell.top + cell.height - 1.8, cell.letters);
      const double room = (cell.width - 4) * scale_;
      line = shrunk_to_width(line, room, std::min(kSmallest, line.height_mm));
      if (narrow != nullptr && text_width(line.text) * line.height_mm > room + 0.01)
        narrow->emplace_back(cell.name);
      line.height_mm = rounded_paper(line.height_mm);
      marks_.texts.push_back(std::move(line));
    }
    marks_.paths.push_back(rectangle(LineClass::frame, block_));
  }

  /// Draws the symbol of the projection: a truncated cone, from the side and from its small end
  /// (ISO 5456-2).
  void symbol(Projection projection) {
    const double y = (kSymbol.top + kSymbol.bottom) / 2, left = kSymbol.left + 7,
                 right = kSymbol.right - 7;
    const bool first = projection == Projection::first_angle;
    const double cone = first ? left : right, round = first ? right : left;
    path({{cone - 3.5, y - 1.5},
          {cone + 3.5, y - 3},
          {cone + 3.5, y + 3},
          {cone - 3.5, y + 1.5},
          {cone - 3.5, y - 1.5}});
    const PaperPoint center = point(round, y);
    for (const double radius : {1.5, 3.0})
      marks_.circles.push_back({LineClass::frame_thin, center, rounded_paper(radius * scale_)});
    const auto axis = [&](const PaperPoint& a, const PaperPoint& b) {
      marks_.paths.push_back({LineClass::grid, {point(a.x, a.y), point(b.x, b.y)}, false});
    };
    axis({cone - 4.5, y}, {cone + 4.5, y});
    axis({round - 4, y}, {round + 4, y});
    axis({round, y - 4}, {round, y + 4});
  }

 private:
  [[nodiscard]] PaperPoint point(double x, double y) const {
    return {rounded_paper(block_.left + x * scale_), rounded_paper(block_.top + y * scale_)};
  }
  [[nodiscard]] Text placed(std::string_view text, double x, double y, double height) const {
    return {LineClass::title, point(x, y), height * scale_, Align::start, std::string(text), false};
  }
  void text(std::string_view text, double x, double y, double height, Align align) {
    Text line = placed(text, x, y, height);
    line.align = align;
    line.height_mm = rounded_paper(line.height_mm);
    line.line = LineClass::frame_thin;
    marks_.texts.push_back(std::move(line));
  }
  void path(std::initializer_list<PaperPoint> points) {
    Path path{LineClass::frame_thin, {}, false};
    for (const PaperPoint& p : points) path.points.push_back(point(p.x, p.y));
    marks_.paths.push_back(std::move(path));
  }
  void box_of_cell(const TitleField& cell) {
    const double height = cell.name == "title" ? cell.height + 11 : cell.height;
    const PaperPoint a = point(cell.left, cell.top);
    const PaperPoint b = point(cell.left + cell.width, cell.top + height);
    marks_.paths.push_back(rectangle(LineClass::frame_thin, {a.x, a.y, b.x, b.y}));
  }

  PaperBox block_;
  double scale_;
  Marks& marks_;
};

}  // namespace

std::vector<std::string> title_block_fields() {
  std::vector<std::string> names;
  for (const TitleField& field : kFields) names.emplace_back(field.name);
  return names;
}

SheetArea sheet_area_of(const SheetSpec& sheet) {
  SheetArea room;
  const bool built_in = sheet.frame && !sheet.artwork;
  if (built_in) {
    const PaperBox border = border_of(sheet);
    room.area = {border.left + kInset, border.top + kInset, border.right - kInset,
                 border.bottom - kInset};
    room.keep_free.push_back(block_of(sheet));
  } else {
    room.area = {kMargin, kMargin, sheet.width_mm - kMargin, sheet.height_mm - kMargin};
  }
  if (sheet.area) room.area = *sheet.area;
  room.keep_free.insert(room.keep_free.end(), sheet.keep_free.begin(), sheet.keep_free.end());
  return room;
}

Marks draw_frame(const SheetSpec& sheet, Lookup field, std::vector<std::string>* narrow) {
  Marks marks;
  const PaperBox border = border_of(sheet);
  marks.paths.push_back(rectangle(LineClass::frame, border));
  const PaperBox taken = block_of(sheet);
  Zones(border, taken, marks).draw();
  TitleBlock block(taken, marks);
  block.draw(field, narrow);
  if (std::any_of(sheet.views.begin(), sheet.views.end(),
                  [](const ViewSpec& view) { return view.slot != ViewSlot::none; }))
    block.symbol(sheet.projection);
  return marks;
}

namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns where the fields of a sheet are given; sheets of a file may have them in common.
std::string where_of_fields(const SheetSpec& what) {
  const std::string where = what.fields_where.empty() ? what.file : what.fields_where;
  return what.name.empty() ? where : where + ", sheet '" + what.name + "'";
}

/// The values of the fields of a sheet.
class Fields {
 public:
  Fields(const SheetSpec& what, std::optional<double> scale) : values_(what.fields) {
    const auto own = [&](std::string name, std::string value) {
      if (find(name) != nullptr) return;
      values_.emplace_back(std::move(name), std::move(value));
    };
    own("scale", scale ? drawing::scale_text(*scale) : std::string(kNoScale));
    own("size", what.size);
    if (!what.name.empty()) own("title", what.name);
    if (!what.name.empty() || what.of > 1)
      own("sheet", std::to_string(what.number) + " of " + std::to_string(what.of));
    const bool arranged = std::any_of(what.views.begin(), what.views.end(),
                                      [](const ViewSpec& v) { return v.slot != ViewSlot::none; });
    if (arranged)
      own("projection", what.projection == Projection::first_angle ? "first angle" : "third angle");
  }

  [[nodiscard]] const std::string* find(const std::string& name) const {
    for (const auto& [key, value] : values_)
      if (key == name) return &value;
    return nullptr;
  }
  [[nodiscard]] std::string text(const std::string& name) const {
    const std::string* const value = find(name);
    return value != nullptr ? on_one_line(*value) : std::string();
  }

  /// Reports fields of the frame without a value, and values without a field.
  void compare(const std::vector<std::string>& places, const std::string& frame,
               const SheetSpec& what, Diagnostics& diagnostics) const {
    std::vector<std::string> empty, idle;
    for (const std::string& name : places)
      if (find(name) == nullptr) empty.push_back(name);
    for (const auto& field : what.fields)
      if (!contains(places, field.first)) idle.push_back(field.first);
    const std::string where = where_of_fields(what);
    // Who gives no fields at all has not forgotten one.
    const bool meant = what.fields_where.empty() && !what.artwork;
    if (!empty.empty())
      diagnostics.add(meant ? Severity::note : Severity::warning, "field-not-filled",
                      "fields of " + frame + " left empty: " + listed(empty) +
                          (meant ? "; [fields] gives them" : ""),
                      where);
    if (!idle.empty())
      diagnostics.add(
          Severity::warning, "field-not-in-template",
          frame + " has no place for " + listed(idle) + "; its fields are " + listed(places),
          where);
  }

 private:
  std::vector<std::pair<std::string, std::string>> values_;
};

}  // namespace

void fill_frame(const SheetSpec& what, std::optional<double> scale, Sheet& sheet) {
  const Fields fields(what, scale);
  const auto text = [&](const std::string& name) { return fields.text(name); };
  sheet.title = text("title");
  if (sheet.title.empty()) sheet.title = what.views.front().title;
  if (what.artwork) {
    fields.compare(what.artwork->fields(), "the template", what, sheet.diagnostics);
    const auto escaped = [&](const std::string& name) { return drawing::xml_escaped(text(name)); };
    sheet.artwork =
        Sheet::Template{what.artwork->view_box, fill_placeholders(what.artwork->pieces, escaped)};
    return;
  }
  if (!what.frame) {
    fields.compare({}, "a sheet without frame", what, sheet.diagnostics);
    return;
  }
  fields.compare(title_block_fields(), "the title block", what, sheet.diagnostics);
  std::vector<std::string> narrow;
  sheet.frame = draw_frame(what, text, &narrow);
  if (!narrow.empty())
    sheet.diagnostics.add(Severity::warning, "field-too-long",
                          "texts are longer than their boxes: " + listed(narrow),
                          where_of_fields(what));
}

}  // namespace strake::sheets
