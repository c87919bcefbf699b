// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "drawing/paper.hpp"
#include "strake/drawing/drawing.hpp"

namespace strake::drawing {

/// Splits lines where they lie on other lines of the view and marks what is covered as duplicate.
///
/// Two lines coincide where they are at most `distance_mm` apart in the plane of the view, measured
/// in the model and not on paper, so that the scale decides nothing. Of two that coincide over a
/// stretch, the visible one stays, then the nearer to the viewer, then that of the lowest object
/// and edge. Lines that are drawn nowhere (projecting, clipped) take no part. The order of lines
/// stays; the parts of a split line follow each other from a to b.
///
/// Cost: lines that share a cell of a grid over the view are compared with each other.
[[nodiscard]] std::vector<Line> mark_duplicates(std::vector<Line> lines, const PaperAxes& axes,
                                                double distance_mm);

}  // namespace strake::drawing
