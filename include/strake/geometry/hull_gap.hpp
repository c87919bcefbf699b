// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "strake/geometry/part_frame.hpp"

namespace strake::geometry {

/// How the convex hulls of two parts lie.
struct HullGap {
  /// Grid units, certain: no two points of the parts are nearer. Not positive: nothing is known.
  double lower = -std::numeric_limits<double>::infinity();
  Vec3d normal;  ///< unit, from b to a: the direction in which they are `lower` apart
};

/// The distance of the hulls of two parts that have vertices, by Gilbert, Johnson and Keerthi
/// (1988). Ends at a lower bound of `enough` grid units. Costs some ten looks at the vertices of
/// either.
[[nodiscard]] HullGap hull_gap(const FramedPart& a, const FramedPart& b, double enough);

}  // namespace strake::geometry
