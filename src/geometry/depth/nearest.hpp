// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "geometry/corners.hpp"
#include "geometry/directions.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/part_tree.hpp"

namespace strake::geometry {

[[nodiscard]] Vec3d nearest_on_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b);

/// The point of a triangle nearest to p.
[[nodiscard]] Vec3d nearest_on_triangle(const Vec3d& p, const Corners& t);

struct NearestTriangle {
  double distance = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNoFace;
};

/// The triangle of a part nearest to p (in the part's own coordinates), if nearer than `limit`;
/// `hint` is tried first and changes only the work. Floating point: relative error about 1e-12.
[[nodiscard]] NearestTriangle nearest_triangle(
    const Part& part, const PartTree& tree, const Vec3d& p, std::uint32_t hint = kNoFace,
    double limit = std::numeric_limits<double>::infinity());

/// The distance to some triangle that is near: no less than that to the nearest.
[[nodiscard]] double some_distance(const Part& part, const PartTree& tree, const Vec3d& p);

}  // namespace strake::geometry
