// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "strake/core/diagnostics.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"

/// Sheets: several views of a model on one piece of paper, with frame, title block, tags and grid
/// lines. docs/sheets.md defines the files that describe them.
///
/// A Sheet is neutral: SVG is written from it, and any other format can be. Coordinates are
/// millimetres of paper, x to the right, y down, from the upper left corner.
namespace strake::sheets {

using drawing::PaperPoint;

/// The classes of lines and texts that styles are given for.
enum class LineClass : std::uint8_t {
  outline,
  edge,
  boundary,
  intersection,
  section,
  hatch,
  polyline,
  smooth,
  hidden,
  grid,
  grid_label,
  leader,
  title,
  frame,
  frame_thin,
  hidden_self,    ///< what its own object hides, where the ink keeps that apart; else `hidden`
  hidden_other,   ///< what others hide, likewise
  centre,         ///< centre lines, which are in the ink of a view
  cutting_plane,  ///< where another view is cut
  extent,         ///< what another view shows
  note,           ///< scale bar, north, levels, lists
  dimension,      ///< dimensions, with their extension lines
  single_line,    ///< pipes that are drawn as their axes
  break_line,     ///< break lines, which are in the ink of a view
  match_line,     ///< where a view ends and another goes on, with its text
};
inline constexpr std::size_t kLineClasses = 25;

/// Returns the name of a class as files spell it: "frame_thin".
[[nodiscard]] std::string_view class_name(LineClass line);
/// Returns the class of a line of a view.
[[nodiscard]] LineClass class_of(hlr::EdgeKind kind, bool hidden);

struct LineStyle {
  double width_mm = 0.25;
  std::vector<double> dash_mm;  ///< lengths of ink and gap by turns; empty: continuous
  model::Color color{0, 0, 0, 255};
};
using LineStyles = std::array<LineStyle, kLineClasses>;

struct PaperBox {
  double left = 0, top = 0, right = 0, bottom = 0;
  [[nodiscard]] double width() const { return right - left; }
  [[nodiscard]] double height() const { return bottom - top; }
  /// Returns whether the two boxes have more than a rim in common.
  [[nodiscard]] bool overlaps(const PaperBox& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  [[nodiscard]] bool holds(const PaperBox& other) const {
    return left <= other.left && top <= other.top && other.right <= right && other.bottom <= bottom;
  }
  [[nodiscard]] PaperBox moved(double x, double y) const {
    return {left + x, top + y, right + x, bottom + y};
  }
  friend bool operator==(const PaperBox&, const PaperBox&) = default;
};

/// Points joined by straight lines; closed when the last is the first.
struct Path {
  LineClass line = LineClass::frame;
  std::vector<PaperPoint> points;
  bool filled = false;  ///< filled with the colour of its class
};

struct Circle {
  LineClass line = LineClass::frame;
  PaperPoint center;
  double radius_mm = 0;
};

enum class Align : std::uint8_t { start, middle, end };

struct Text {
  LineClass line = LineClass::title;  ///< the class whose colour it has
  PaperPoint at;                      ///< a point on the base line
  double height_mm = 3.5;             ///< of a capital letter
  Align align = Align::start;
  std::string text;
  bool clears = false;  ///< clears the paper behind it: lines end there
  double turn_deg = 0;  ///< about `at`, against the clock: more than -90, at most 90
};

/// Lines and texts that are drawn beside the lines of the model.
struct Marks {
  std::vector<Path> paths;
  std::vector<Circle> circles;
  std::vector<Text> texts;
};

/// A view in its place on the sheet.
struct PlacedView {
  std::string name, title;
  drawing::NeutralDrawing drawing;  ///< its data without its lines, which are in `ink`
  drawing::Ink ink;
  PaperBox box;  ///< box of all lines of the view, hidden ones included
  Marks caption, grid, tags;
  Marks frame;  ///< round a view in perspective
  Marks notes;  ///< levels, cutting planes and extents of other views
  Marks match_lines;
};

struct Sheet {
  std::string name;   ///< among the sheets of its file; empty where it is the only one
  std::string title;  ///< title of the file that is written
  double width_mm = 420, height_mm = 297;
  LineStyles styles;
  std::vector<PlacedView> views;
  Marks frame;  ///< the built-in border and title block; empty with a template
  /// A template with its fields filled in, in the place of `frame`: elements of SVG and a viewBox
  /// of the size of the sheet, or what a nested `<svg>` with that viewBox shows.
  struct Template {
    std::string view_box, elements;
  };
  std::optional<Template> artwork;
  Marks notes;  ///< scale bar, north, lists
  /// "view-empty", "selection-matches-nothing", "field-not-filled", "field-not-in-template",
  /// "view-off-the-sheet", "views-overlap", "tag-no-room" … (docs/sheets.md)
  Diagnostics diagnostics;
};

}  // namespace strake::sheets
