// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A point as integers over a common denominator in 1..4096; grid units.
struct ScaledPoint {
  Vec3l numerator;
  std::int64_t denominator = 1;

  /// Returns the vector from a grid point to this one, times the denominator.
  [[nodiscard]] constexpr Vec3l from(const Vec3l& p) const { return numerator - p * denominator; }
};

/// Where a point lies with respect to a closed set: outside, on its boundary (the surface of a
/// body, the border of a polygon), or inside. Exact for differences of at most 2^31 units.
enum class PointSide : std::uint8_t { outside, on_boundary, inside };

/// Returns the feature of a non-degenerate triangle that a point lies on: a corner, an edge or the
/// interior; 0 when the point is off the plane or beyond the edges.
[[nodiscard]] FeatureMask feature_of(const TriangleCorners& triangle, const ScaledPoint& p);

/// Locates a point in a polygon with holes, both seen along `axis` (0, 1, 2; the coordinate along
/// it is ignored).
///
///     const std::vector<std::uint32_t> first{0, 4, 8};  // a square and a square hole
///     if (side_of_polygon(points, first, 2, {p, 1}) == PointSide::inside) ...
///
/// Contour i is points[first[i] .. first[i + 1]), closed without repeating its first point. The
/// interior is what an odd number of contours surround, whatever their sense, as in
/// triangulate.hpp; the border is every point of an edge, also of one that is drawn twice. Repeated
/// points, contours that touch or cross and empty ones are fine. Crossings are counted on a ray
/// moved by an infinitesimal amount, so that one through a corner is counted correctly (M. Shimrat,
/// 1962). O(n).
[[nodiscard]] PointSide side_of_polygon(std::span<const Vec3l> points,
                                        std::span<const std::uint32_t> first, int axis,
                                        const ScaledPoint& p);

/// Locates a point in the polyhedron of a part's triangles, in the part's own coordinates. A point
/// is inside where the outward surface winds round it at least once; a sheet has no interior. A
/// point on the surface is on the boundary, also on a face in the interior. Visits every triangle:
/// this is the reference for side_of() in part_pair.hpp, which traverses the part's BVH.
[[nodiscard]] PointSide side_of_polyhedron(const Part& part, const ScaledPoint& p);

}  // namespace strake::geometry
