// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0030 says why planes come before triangles at intersections.

#include "geometry/bvh/pair_local_part.hpp"

namespace strake::geometry {

/// Whether the plane of a triangle has the parts on opposite closed sides, `below` on the negative
/// one; for a sheet a point off the plane is asked for as well. Exact; early out at the first
/// vertex on the wrong side. Then neither part has a point in the other's interior, and neither
/// holds the other.
[[nodiscard]] bool is_separating_plane(const ExactTriangle& triangle, const PairLocalPart& below,
                                       const PairLocalPart& above);

/// Whether the plane keeps the parts apart: `above` strictly on its positive side, `below` on the
/// closed negative one.
[[nodiscard]] bool is_strictly_separating_plane(const ExactTriangle& triangle,
                                                const PairLocalPart& below,
                                                const PairLocalPart& above);

/// Whether a lies on one side of the plane of each triangle of b: none of it beyond, and not all of
/// it in the plane. Exact, but false where there would be too many planes and vertices to ask.
///
/// Then neither skin passes through the other, flush as they may lie: round any line in which
/// triangles of b end that a touches, all of a lies in the angle that their half-planes leave it,
/// with none of them inside that angle; so that a is never on both sides of b, nor along an area in
/// which they lie on each other now on the one side and now on the other.
[[nodiscard]] bool lies_on_one_side(const PairLocalPart& a, const PairLocalPart& b);

}  // namespace strake::geometry
