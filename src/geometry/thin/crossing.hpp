// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/part_pair.hpp"
#include "strake/geometry/thin_body.hpp"

namespace strake::geometry::thin {

/// Where a line passes through a sheet from one side to the other, farthest from the sheet's rim
/// and the line's own ends.
struct Crossing {
  double depth = 0;  ///< the smaller of the two distances, grid units; 0: it does not pass through
  Vec3d point;       ///< relative to the sheet's origin
};

/// Exact but for the rounding of the point and the distances. A corner of the line that lies in the
/// sheet counts as passing through where its neighbours lie on opposite sides; what runs along the
/// sheet does not. Only segments count.
[[nodiscard]] Crossing deepest_crossing(const ThinBody& line, const TreedPart& sheet);

}  // namespace strake::geometry::thin
