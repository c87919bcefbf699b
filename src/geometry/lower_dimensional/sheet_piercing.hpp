// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/lower_dimensional_body.hpp"
#include "strake/geometry/part_pair.hpp"

namespace strake::geometry::lower_dimensional {

/// The point where a line pierces a sheet from one side to the other, farthest from the sheet's
/// border and the line's own ends.
struct SheetPiercing {
  double depth = 0;  ///< the smaller of the two distances, grid units; 0: it does not pierce
  Vec3d point;       ///< relative to the sheet's origin
};

/// Returns the deepest piercing, exact but for the rounding of the point and the distances. A
/// vertex of the line in the sheet counts as piercing where its neighbours lie on opposite sides; a
/// line along the sheet does not. Only segments count.
[[nodiscard]] SheetPiercing deepest_piercing(const LowerDimensionalBody& line,
                                             const PartWithBvh& sheet);

}  // namespace strake::geometry::lower_dimensional
