// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "drawing/collinear/collinear_overlaps.hpp"
#include "drawing/layout/view_plane.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// Finds where pieces lie on other pieces of the view. A line of the result is the number of a
/// piece.
///
/// Two pieces coincide where they are at most `distance_mm` apart in the plane of the view,
/// measured in the model and not on paper, so that the scale decides nothing, and parallel as
/// OverlapRule says. Of two that coincide over an interval, the visible one stays, then the nearer
/// to the viewer, then that of the lowest object and edge. Pieces that are drawn nowhere
/// (projecting, clipped) take no part.
[[nodiscard]] Result<LineOverlaps> find_duplicates(const hlr::Drawing& drawing,
                                                   const PaperAxes& axes, double distance_mm,
                                                   const parallel::Context& context);

/// The steps of find_duplicates(): flatten() projects the pieces to the plane of the view, relative
/// to the drawing's origin, so that nothing depends on what else is drawn; duplicate_rule() says
/// when they coincide.
[[nodiscard]] Result<std::vector<PlaneSegment>> flatten(const hlr::Drawing& drawing,
                                                        const PaperAxes& axes, double distance_mm,
                                                        const parallel::Context& context);
[[nodiscard]] OverlapRule duplicate_rule(double distance_mm);

[[nodiscard]] bool is_hidden(LineState state);

/// Returns the part of a line between two parameters on paper, 0 at a and 1 at b.
[[nodiscard]] Line part_of(const Line& line, const PaperAxes& axes, double from, double to);

}  // namespace strake::drawing
