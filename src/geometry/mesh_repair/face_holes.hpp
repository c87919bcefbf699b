// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// Whether a sheet lacks only pieces of its flat faces: each boundary loop lies in a plane, up to
/// rounding to the grid, that also holds a triangle at that loop, and with it at least as much of
/// the sheet as the loop surrounds. This holds for a missing triangle of a box or a prism and for a
/// window in a wall; it does not for a tank without a lid, with or without a flange. False where
/// there is no boundary, where loops meet at a vertex, and for more than 16 loops.
///
/// O(n) for a part of n edges.
[[nodiscard]] bool has_incomplete_faces(const Part& part);

}  // namespace strake::geometry
