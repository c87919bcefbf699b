// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// Whether a sheet lacks pieces of its flat faces and nothing else: each rim of it runs round in a
/// plane, up to rounding to the grid, in which a triangle at that rim lies too, and with it as much
/// of the sheet or more as the rim surrounds. So runs the rim of a triangle that a box or a prism
/// has too few, or of a window in a wall; that of a tank without a lid does not, with a flange or
/// without. False where there is no rim, where rims meet at a vertex, and for more than 16 of them.
///
/// O(n) for a part of n edges.
[[nodiscard]] bool has_incomplete_faces(const Part& part);

}  // namespace strake::geometry
