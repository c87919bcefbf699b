// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

[[nodiscard]] inline double length(const Vec3d& v) { return std::sqrt(dot(v, v)); }

/// For a vector that is not zero.
[[nodiscard]] inline Vec3d unit(const Vec3d& v) { return v * (1 / length(v)); }

/// A unit vector square to a unit vector: to the axis that this one leans on least, too.
[[nodiscard]] inline Vec3d square_to(const Vec3d& n) {
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  const Vec3d other = x <= y && x <= z ? Vec3d{1, 0, 0} : y <= z ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
  const Vec3d v = cross(n, other);
  return v * (1 / length(v));
}

}  // namespace strake::geometry
