// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/rational.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {

/// What planes have in common.
enum class CommonOfPlanes : std::uint8_t {
  /// Nothing: two are parallel, or each two of three meet in a line and these lines are parallel.
  nothing,
  point,  ///< three planes alone
  line,   ///< of three planes: two of them may be one
  plane,  ///< all are the same plane
};

/// The line in which two planes meet and the point in which three do:
///
///     const ThreePlanes corner = intersect_planes(floor, wall, bulkhead);
///     if (corner.common == CommonOfPlanes::point) ...   // corner.point.value(), in grid units
///
/// 1. A plane is given by three grid points that span it; its normal is (b-a) x (c-a). Points that
///    span no plane are an error of the caller (asserted).
/// 2. What planes have in common is exact in the range of grid_shapes.hpp: nothing is taken for
///    parallel that is not. Points and directions are exact rationals, not reduced.
/// 3. Planes that are nearly parallel meet far outside the range of the grid; such a point is exact
///    as well, and nearest_on_grid() tells it from others.
///
/// Why the types suffice, for differences of coordinates up to 2^31: a triangle in a square of that
/// side has at most half of its area, so components of normals are at most 2^62, those of the cross
/// product of two normals 2^125, their determinant 3·2^187 and what it divides less than 2^222.
/// With an origin up to 2^50 away numerators stay below 2^240.
///
/// Pure; no allocation; well below a microsecond.
///
/// The point of three planes is that of R. Goldman, Intersection of Three Planes (Graphics Gems,
/// 1990); the line of two follows by Cramer's rule from one coordinate that is kept.

/// A straight line without ends: point + t · direction, in grid units.
struct ExactLine {
  RationalPoint point;
  Vec3<Int128> direction;  ///< the cross product of the planes' normals, in their order
};

struct TwoPlanes {
  CommonOfPlanes common = CommonOfPlanes::nothing;  ///< nothing, line or plane
  ExactLine line;                                   ///< where that is a line
};
/// Intersects two planes. The line's point has one coordinate in common with a's first point.
[[nodiscard]] TwoPlanes intersect_planes(const TriangleCorners& a, const TriangleCorners& b);

struct ThreePlanes {
  CommonOfPlanes common = CommonOfPlanes::nothing;
  WideRationalPoint point;  ///< where that is a point
  ExactLine line;           ///< where that is a line: of the first two planes that are not parallel
};
/// Intersects three planes.
[[nodiscard]] ThreePlanes intersect_planes(const TriangleCorners& a, const TriangleCorners& b,
                                           const TriangleCorners& c);

/// Returns the grid point that is nearest to a point, ties away from zero; nothing where a
/// coordinate lies beyond 2^50 units (kMaxGridMm), where no grid point may be placed.
[[nodiscard]] std::optional<Vec3l> nearest_on_grid(const WideRationalPoint& point);

}  // namespace strake::geometry
