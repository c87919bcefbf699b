// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "geometry/corners.hpp"
#include "geometry/directions.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/part_tree.hpp"

namespace strake::geometry {

[[nodiscard]] Vec3d nearest_on_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b);

/// The point of a triangle nearest to p.
[[nodiscard]] Vec3d nearest_on_triangle(const Vec3d& p, const Corners& t);

/// A triangle as it is asked for again and again, in the part's own coordinates.
struct PreparedTriangle {
  Corners corners;
  Vec3d unit;             ///< normal; none without area
  double lo = 0, hi = 0;  ///< least and greatest unit·x of its corners
  double size = 0;        ///< twice the area

  explicit PreparedTriangle(const Corners& c) : corners(c) {
    const Vec3d n = normal_of(c);
    size = length(n);
    if (!(size > 0)) return;
    unit = n * (1 / size);
    const double x = dot(unit, c[0]), y = dot(unit, c[1]), z = dot(unit, c[2]);
    lo = std::min({x, y, z});
    hi = std::max({x, y, z});
  }

  [[nodiscard]] PreparedTriangle moved(const Vec3d& by) const {
    PreparedTriangle there = *this;
    for (Vec3d& p : there.corners) p = p + by;
    there.lo += dot(unit, by);
    there.hi += dot(unit, by);
    return there;
  }
};

struct NearestTriangle {
  double distance = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNoFace;
  std::uint32_t visited = 0;  ///< nodes of the tree that the question went to
};

/// The triangle of a part nearest to p (in the part's own coordinates), if nearer than `limit`;
/// `hint` is tried first and changes only the work, and so does `prepared`: all triangles, or none.
/// Floating point: relative error about 1e-12.
[[nodiscard]] NearestTriangle nearest_triangle(
    const Part& part, const PartTree& tree, const Vec3d& p, std::uint32_t hint = kNoFace,
    double limit = std::numeric_limits<double>::infinity(),
    std::span<const PreparedTriangle> prepared = {});

/// The distance to some triangle that is near: no less than that to the nearest.
[[nodiscard]] double some_distance(const Part& part, const PartTree& tree, const Vec3d& p);

}  // namespace strake::geometry
