// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "geometry/corners.hpp"

namespace strake::geometry {

/// Squared distance of a point to a triangle, in doubles.
[[nodiscard]] inline double squared_distance(const Vec3d& p, const Corners& t) {
  const Vec3d u = t[1] - t[0], v = t[2] - t[0], n = cross(u, v);
  double least = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d &from = t[i], e = t[(i + 1) % 3] - from, d = p - from;
    inside = inside && dot(cross(e, d), n) >= 0;
    const double along = std::clamp(dot(e, d) / dot(e, e), 0.0, 1.0);
    const Vec3d off = d - e * along;
    least = std::min(least, dot(off, off));
  }
  if (!inside) return least;
  const double height = dot(n, p - t[0]);
  return std::min(least, height * height / dot(n, n));
}

}  // namespace strake::geometry
