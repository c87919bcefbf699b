// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0030 says why planes come before triangles at intersections.

#include "geometry/bvh/pair_local_part.hpp"

// Tests whether planes of triangles separate two parts.

namespace strake::geometry {

/// Whether the plane of a triangle has the parts on opposite closed sides, `below` on the negative
/// one; a sheet must also have a point off the plane. Exact; early out at the first vertex on the
/// wrong side. Then neither part has a point in the other's interior, and neither holds the other.
[[nodiscard]] bool is_separating_plane(const ExactTriangle& triangle, const PairLocalPart& below,
                                       const PairLocalPart& above);

/// Whether the plane strictly separates the parts: `above` strictly on its positive side, `below`
/// on the closed negative one.
[[nodiscard]] bool is_strictly_separating_plane(const ExactTriangle& triangle,
                                                const PairLocalPart& below,
                                                const PairLocalPart& above);

/// Whether a lies on one side of the plane of each triangle of b: none of it beyond, and not all of
/// it in the plane. Exact, but false where there are too many planes and vertices to test.
///
/// Then neither surface crosses the other, even where they overlap: round any edge of b that a
/// touches, all of a lies in the angle between the half-planes of b, with none of them inside that
/// angle; so a is never on both sides of b, nor does it leave a common area to one side here and to
/// the other there.
[[nodiscard]] bool lies_on_one_side(const PairLocalPart& a, const PairLocalPart& b);

}  // namespace strake::geometry
