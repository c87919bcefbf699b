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

  /// The way from a grid point to this one, times the denominator.
  [[nodiscard]] constexpr Vec3l from(const Vec3l& p) const { return numerator - p * denominator; }
};

/// Where a point lies with respect to a closed set: outside, on its boundary (the skin of a body,
/// the rim of a polygon), or inside. Exact for differences of at most 2^31 units.
enum class PointSide : std::uint8_t { outside, on_boundary, inside };

/// The place of a point on a triangle that has an area: its corner, edge or inside, or 0 when the
/// point is off the plane or beyond the edges.
[[nodiscard]] FeatureMask feature_of(const TriangleCorners& triangle, const ScaledPoint& p);

/// A point against a polygon with holes, both seen along `axis` (0, 1, 2; the coordinate along it
/// counts for nothing).
///
///     const std::vector<std::uint32_t> first{0, 4, 8};  // a square and a square hole
///     if (side_of_polygon(points, first, 2, {p, 1}) == PointSide::inside) ...
///
/// Contour i is points[first[i] .. first[i + 1]), closed without repeating its first point. Inside
/// is what an odd number of contours surround, whatever their sense, as in triangulate.hpp; the rim
/// is every point of an edge, also of one that is drawn twice. Repeated points, contours that touch
/// or cross and empty ones are fine. A ray's crossings are counted on a ray moved by an
/// infinitesimal amount, so that one through a corner counts rightly (M. Shimrat, 1962). O(n).
[[nodiscard]] PointSide side_of_polygon(std::span<const Vec3l> points,
                                        std::span<const std::uint32_t> first, int axis,
                                        const ScaledPoint& p);

/// A point against a polyhedron: the part's triangles where it stands in its own coordinates.
/// Inside is where its outward surface winds round the point at least once; a sheet has no inside.
/// Looks at every triangle: the twin and oracle of side_of() in part_pair.hpp, which asks the
/// part's tree. A point on the skin is on the boundary, also of a face in the inside.
[[nodiscard]] PointSide side_of_polyhedron(const Part& part, const ScaledPoint& p);

}  // namespace strake::geometry
