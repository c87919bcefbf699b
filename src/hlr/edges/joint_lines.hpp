// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0046 says which lines between primitives of one object are edges.

#include <cstdint>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::hlr {

/// Returns those of the intersection lines of two primitives of one object that are edges of the
/// body that the two make together. Lines are relative to a's origin, as b is.
///
/// Facets of round skins that run along each other cross anywhere within their sags, so lines of
/// coaxial and tangent joints are noise:
/// - A line that lies within the sags of both and the contact distance of an edge of either is left
///   out: that edge is drawn already.
/// - A line is also left out where the skins turn by no more than the sharp angle, as between any
///   two faces, or face each other within a milliradian, as flush ends do.
/// - Lines on a shortest path between the ends of lines that stay are kept, too: near the apex of a
///   tee the skins are tangent, and the saddle goes on.
///
/// Cost: for each line the triangles and the edges of both parts. Errors: those of feature_edges().
[[nodiscard]] Result<std::vector<geometry::Segment>> joint_lines(
    const geometry::PlacedPart& a, const geometry::PlacedPart& b, std::int64_t contact,
    double cos_sharp, std::vector<geometry::Segment> lines);

}  // namespace strake::hlr
