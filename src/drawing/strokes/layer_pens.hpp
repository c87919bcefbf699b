// SPDX-License-Identifier: Apache-2.0
// The pens of the layers of a view, and of the styles of objects in them.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "drawing/strokes/layers.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/drawing/object_styles.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/detail/function_ref.hpp"

namespace strake::drawing {

/// How lines are drawn, mm of paper.
struct LinePen {
  double width_mm = 0.25;
  std::vector<double>
      dash_mm;  ///< lengths of ink and gap by turns, flat at their ends; empty: none
  model::Color color{0, 0, 0, 255};
};

/// The pen of a layer; of a hidden one, for the lines that are hidden in this way.
using PenOfLayer = parallel::FunctionRef<LinePen(const Layer&, LineState)>;

/// Returns the pen of a layer of a drawing that has no styles of its own.
[[nodiscard]] LinePen usual_pen(const Layer& layer, const Pens& pens);

/// Returns the pen that lines of a style have where all others have `usual`.
[[nodiscard]] LinePen styled_pen(LinePen usual, const Layer& layer, const ObjectStyles& styles,
                                 std::size_t number, double edge_mm);

/// Returns the pen of the break lines of a style, which have no type of line of it: zigzags in
/// dashes are none.
[[nodiscard]] LinePen styled_break_pen(LinePen usual, const ObjectStyles& styles,
                                       std::size_t number, double edge_mm);

/// Lines of one style, in the order of the drawing.
template <class L>
struct StyledLines {
  std::size_t style = ObjectStyles::kPlain;
  std::vector<const L*> lines;
};
using LinesOfStyle = StyledLines<Line>;
using BreakLinesOfStyle = StyledLines<BreakLine>;

/// Parts lines by their styles: those without a style first, then style by style.
[[nodiscard]] std::vector<LinesOfStyle> by_style(std::span<const Line* const> lines,
                                                 const Ink& ink);

/// Parts the break lines of a view by the styles of their objects.
[[nodiscard]] std::vector<BreakLinesOfStyle> break_lines_by_style(const Ink& ink);

/// Returns what people call a style: its name, or "style 2".
[[nodiscard]] std::string style_label(const ObjectStyles& styles, std::size_t number);

}  // namespace strake::drawing
