// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/obb/rotated_part.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/triangle_bvh.hpp"

namespace strake::geometry {

[[nodiscard]] Vec3d nearest_on_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b);

/// Returns the point of a triangle nearest to p.
[[nodiscard]] Vec3d nearest_on_triangle(const Vec3d& p, const Corners& t);

/// A triangle prepared for many distance queries, in the part's own coordinates.
struct PreparedTriangle {
  Vec3d unit;             ///< normal; none without area
  double lo = 0, hi = 0;  ///< least and greatest unit·x of its corners
  double size = 0;        ///< twice the area
  Corners corners;
  /// Unit vectors in its plane, perpendicular to its edges; zero for a sliver.
  std::array<Vec3d, 3> inwards{};

  explicit PreparedTriangle(const Corners& c);

  /// Whether a point projects into the triangle from its inner side.
  [[nodiscard]] bool has_behind(const Vec3d& p) const {
    const auto inside = [&](std::size_t i) { return dot(inwards[i], p - corners[i]) > 0; };
    return dot(unit, p) < lo && inside(0) && inside(1) && inside(2);
  }

  /// Returns nearest_on_triangle() of the triangle.
  [[nodiscard]] Vec3d nearest(const Vec3d& p) const;

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
  std::uint32_t triangle = kNoIndex;
  std::uint32_t visited = 0;  ///< nodes of the tree visited
};

/// The triangles of a part and their boxes: those of its tree or in a rotated frame. Prepared
/// triangles (all or none) and the frame change only the work.
struct SurfaceBvh {
  const Part& part;
  const TriangleBvh& tree;
  const RotatedFrame* frame = nullptr;
  std::span<const PreparedTriangle> prepared = {};
};

/// Returns the triangle of a part nearest to p (in the part's own coordinates), if nearer than
/// `limit`; `hint` is tried first and changes only the work. Floating point: relative error about
/// 1e-12.
[[nodiscard]] NearestTriangle nearest_triangle(
    const SurfaceBvh& surface, const Vec3d& p, std::uint32_t hint = kNoIndex,
    double limit = std::numeric_limits<double>::infinity());

/// Returns the distance to some near triangle: no less than that to the nearest.
[[nodiscard]] double distance_upper_bound(const SurfaceBvh& surface, const Vec3d& p);

}  // namespace strake::geometry
