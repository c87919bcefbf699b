// SPDX-License-Identifier: Apache-2.0
#include "sheets/arrangement/view_margins.hpp"

#include <algorithm>
#include <cmath>

#include "drawing/layout/view_plane.hpp"
#include "sheets/arrangement/grid_lines.hpp"
#include "sheets/arrangement/levels.hpp"
#include "sheets/arrangement/view_arrangement.hpp"
#include "sheets/arrangement/view_paper.hpp"

namespace strake::sheets {

namespace {

/// What the letter at the end of a cutting plane needs beyond that end.
constexpr double kLetterMarginMm = 4;
/// The paper beyond the line of a dimension, for the text that stands on it.
constexpr double kAboveLineMm = 5;

/// Returns whether a view shows where others are cut: it sees a plane of one with a mark edge-on.
bool shows_cutting_planes(const SheetSpec& what, const ViewSpec& view) {
  return !view.view.perspective && std::ranges::any_of(what.views, [&](const ViewSpec& cut) {
    return !cut.section_mark.empty() && cut.name != view.name &&
           std::ranges::any_of(cut.view.sections, [&](const hlr::Section& section) {
             return dot(section.normal, view.view.direction) == 0;
           });
  });
}

/// Widens margins for match lines, which have their texts outside.
void add_match_lines(const SheetSpec& what, const ViewSpec& view, ViewMargins& margins) {
  const auto axes = drawing::paper_axes(view.view);
  if (!axes) return;
  const double text_mm = lettering_of(what).scale_mm + 2.5;
  for (const NeighbourView& neighbour : view.neighbours) {
    const double sign = neighbour.upper ? 1 : -1;
    const double right = sign * axes->right[neighbour.axis], up = sign * axes->up[neighbour.axis];
    // How far each side of the paper is that of the match line: 1 where it leads out of there.
    const auto widen = [&](double& margin, double out) {
      if (out > 0.1) margin = std::max(margin, text_mm);
      if (std::fabs(out) < 0.9) margin = std::max(margin, kMatchBeyondMm);
    };
    widen(margins.left_mm, -right);
    widen(margins.right_mm, right);
    widen(margins.top_mm, up);
    widen(margins.bottom_mm, -up);
  }
}

/// Returns the side on which a dimension stands.
double& side_of(const DimensionSpec& dimension, ViewMargins& margins) {
  if (dimension.along == DimensionSpec::Along::vertical)
    return dimension.other_side ? margins.right_mm : margins.left_mm;
  return dimension.other_side ? margins.bottom_mm : margins.top_mm;
}

}  // namespace

ViewMargins dimension_margins(const SheetSpec& what, const ViewSpec& view) {
  ViewMargins margins;
  for (const DimensionSpec& dimension : what.dimensions) {
    if (dimension.view != view.name || dimension.along == DimensionSpec::Along::aligned) continue;
    double& side = side_of(dimension, margins);
    side = std::max(side, dimension.offset_mm + kAboveLineMm);
  }
  return margins;
}

ViewMargins label_margins(const SheetSpec& what, const ViewSpec& view) {
  ViewMargins margins = dimension_margins(what, view);
  if (view.view.perspective) return margins;
  const GridMargin grid = grid_margin(what.grid, view);
  margins.left_mm += std::max(grid.left_mm, grid.other_mm);
  margins.top_mm += std::max(grid.top_mm, grid.other_mm);
  margins.right_mm += std::max(grid.other_mm, level_margin(what.levels, view));
  margins.bottom_mm += grid.other_mm;
  return margins;
}

ViewMargins margins_of(const SheetSpec& what, const ViewSpec& view) {
  ViewMargins margins = label_margins(what, view);
  const bool cut = shows_cutting_planes(what, view);
  for (double* const side :
       {&margins.left_mm, &margins.top_mm, &margins.right_mm, &margins.bottom_mm}) {
    if (cut) *side = reach_of_plane(*side) + kLetterMarginMm;
    if (view.view.perspective) *side = std::max(*side, drawing::kFrameGapMm);
  }
  add_match_lines(what, view, margins);
  return margins;
}

}  // namespace strake::sheets
