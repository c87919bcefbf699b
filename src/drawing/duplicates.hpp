// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "drawing/paper.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// Splits lines where they lie on other lines of the view and marks what is covered as duplicate.
///
/// Two lines coincide where they are at most `distance_mm` apart in the plane of the view, measured
/// in the model and not on paper, so that the scale decides nothing. Of two that coincide over a
/// stretch, the visible one stays, then the nearer to the viewer, then that of the lowest object
/// and edge. Lines that are drawn nowhere (projecting, clipped) take no part. The order of lines
/// stays; the parts of a split line follow each other from a to b.
[[nodiscard]] Result<std::vector<Line>> mark_duplicates(std::vector<Line> lines,
                                                        const PaperAxes& axes, double distance_mm,
                                                        const parallel::Context& context);

[[nodiscard]] bool is_hidden(LineState state);

/// The part of a line between two parameters, 0 at a and 1 at b.
[[nodiscard]] Line part_of(const Line& line, double from, double to);

}  // namespace strake::drawing
