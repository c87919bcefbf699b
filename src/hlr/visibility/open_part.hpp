// SPDX-License-Identifier: Apache-2.0
// Where on paper the part of an edge lies that is still to be decided, and queries for what may
// hide any of it; orthographic. Decision 0074 says why its sides count.
#pragma once

#include "hlr/view/projection.hpp"
#include "hlr/view/view_bvh.hpp"
#include "hlr/visibility/visibility_intervals.hpp"

namespace strake::hlr {

/// Returns a box that meets the box of everything that may hide any of the open part of the edge
/// from a to b on a side that is open. Touching hides nothing: where the edge has an extent it is a
/// unit shorter at both ends, so that it may be inside out, and where an edge along the other axis
/// is open on one side only it is a unit farther on that side.
[[nodiscard]] ViewBox open_box(const ViewPoint& a, const ViewPoint& b, const OpenRange& open);

/// Returns the query for what may hide the open part of an edge in boxes that are rotated.
[[nodiscard]] SegmentQuery rotated_query(const ViewPoint& a, const ViewPoint& b,
                                         const OpenRange& open, const PaperRotation& rotation);

}  // namespace strake::hlr
