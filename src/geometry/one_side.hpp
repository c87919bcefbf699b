// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/pair_view.hpp"

namespace strake::geometry {

/// Whether a lies on one side of the plane of each triangle of b: none of it beyond, and not all of
/// it in the plane. Exact, but false where there would be too many planes and vertices to ask.
///
/// Then neither skin passes through the other, flush as they may lie: round any line in which
/// triangles of b end that a touches, all of a lies in the angle that their half-planes leave it,
/// with none of them inside that angle; so that a is never on both sides of b, nor along an area in
/// which they lie on each other now on the one side and now on the other.
[[nodiscard]] bool lies_on_one_side(const PartView& a, const PartView& b);

}  // namespace strake::geometry
