// SPDX-License-Identifier: Apache-2.0
#include "sheets/arrangement/view_margins.hpp"

#include <algorithm>

#include "drawing/layout/view_plane.hpp"
#include "sheets/arrangement/grid_lines.hpp"
#include "sheets/arrangement/levels.hpp"

namespace strake::sheets {

namespace {

/// What a cutting plane with its arrows and letters needs on all sides.
constexpr double kCuttingPlaneMarginMm = 12;
/// The paper beyond the line of a dimension, for extension lines and half a text.
constexpr double kDimensionMarginMm = 5;

/// Returns whether a view shows where others are cut: it sees a plane of one with a mark edge-on.
bool shows_cutting_planes(const SheetSpec& what, const ViewSpec& view) {
  return !view.view.perspective && std::ranges::any_of(what.views, [&](const ViewSpec& cut) {
    return !cut.section_mark.empty() && cut.name != view.name &&
           std::ranges::any_of(cut.view.sections, [&](const hlr::Section& section) {
             return dot(section.normal, view.view.direction) == 0;
           });
  });
}

/// Returns the side on which a dimension stands.
double& side_of(const DimensionSpec& dimension, ViewMargins& margins) {
  if (dimension.along == DimensionSpec::Along::vertical)
    return dimension.other_side ? margins.right_mm : margins.left_mm;
  return dimension.other_side ? margins.bottom_mm : margins.top_mm;
}

}  // namespace

ViewMargins margins_of(const SheetSpec& what, const ViewSpec& view) {
  constexpr double kGap = drawing::kFrameGapMm;
  const GridMargin rim =
      view.view.perspective ? GridMargin{kGap, kGap, kGap} : grid_margin(what.grid, view);
  ViewMargins margins{std::max(rim.left_mm, rim.other_mm), std::max(rim.top_mm, rim.other_mm),
                      std::max(rim.other_mm, level_margin(what.levels, view)), rim.other_mm};
  if (shows_cutting_planes(what, view))
    for (double* const side :
         {&margins.left_mm, &margins.top_mm, &margins.right_mm, &margins.bottom_mm})
      *side = std::max(*side, kCuttingPlaneMarginMm);
  for (const DimensionSpec& dimension : what.dimensions) {
    if (dimension.view != view.name || dimension.along == DimensionSpec::Along::aligned) continue;
    double& side = side_of(dimension, margins);
    side = std::max(side, dimension.offset_mm + kDimensionMarginMm);
  }
  return margins;
}

}  // namespace strake::sheets
