// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

#include "strake/geometry/vec.hpp"

namespace strake::bench {

using WorldTriangle = std::array<geometry::Vec3d, 3>;

/// Separating axes in doubles (Gottschalk, Lin and Manocha 1996): a touch counts as meeting, and
/// rounding may lose one. What Embree leaves to its caller.
inline bool triangles_meet(WorldTriangle a, WorldTriangle b) {
  using geometry::Vec3d;
  const Vec3d origin = a[0];  // keeps the digits far from the world's origin
  for (WorldTriangle* t : {&a, &b})
    for (Vec3d& p : *t) p = p - origin;
  const auto parted = [&](const Vec3d& axis) {
    const std::array<double, 3> x{dot(axis, a[0]), dot(axis, a[1]), dot(axis, a[2])},
        y{dot(axis, b[0]), dot(axis, b[1]), dot(axis, b[2])};
    return std::max({x[0], x[1], x[2]}) < std::min({y[0], y[1], y[2]}) ||
           std::max({y[0], y[1], y[2]}) < std::min({x[0], x[1], x[2]});
  };
  const std::array<Vec3d, 3> u{a[1] - a[0], a[2] - a[1], a[0] - a[2]},
      v{b[1] - b[0], b[2] - b[1], b[0] - b[2]};
  const Vec3d n = cross(u[0], u[1]), m = cross(v[0], v[1]);
  if (parted(n) || parted(m)) return false;
  for (const Vec3d& p : u)
    for (const Vec3d& q : v)
      if (parted(cross(p, q))) return false;
  // In one plane the sides' own normals part them.
  for (std::size_t k = 0; k < 3; ++k)
    if (parted(cross(n, u[k])) || parted(cross(m, v[k]))) return false;
  return true;
}

}  // namespace strake::bench
