// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/corners.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// Where a segment comes nearest to a triangle.
struct SegmentNear {
  double squared = 0;  ///< distance
  double along = 0;    ///< from 0 at its start to 1 at its end
};

/// In double arithmetic, off by some roundings of the coordinates. Zero where they meet.
[[nodiscard]] SegmentNear nearest_along(const Vec3d& from, const Vec3d& to, const Corners& t);

}  // namespace strake::geometry
