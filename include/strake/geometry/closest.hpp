// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/rational.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// The closest points of two shapes, exactly: the squared distance and both points as rationals.
struct ClosestPoints {
  SquaredDistance squared;  ///< zero when the shapes share a point
  RationalPoint on_a, on_b;
  /// The feature whose relative interior holds the point.
  FeatureMask feature_a = 1, feature_b = 1;
};

/// Returns the closest points of two shapes on the integer grid.
///
///     const ClosestPoints c = closest_points(Segment{a, b}, TriangleCorners{p, q, r});
///     if (c.squared < limit) report(c.on_a.value(), c.squared.distance());
///
/// 1. Exact in the range of grid_shapes.hpp; distances compare exactly by SquaredDistance, also
///    against those of other pairs.
/// 2. Among pairs of features equally near, the first counts: vertex and vertex, vertex and edge,
///    edge and vertex, vertex and face, face and vertex, edge and edge, edge and face, face and
///    edge; in each kind by the numbers of a's features, then b's. So parallel shapes have an
///    answer of their own too; the squared distance does not depend on how the shapes are written
///    down.
/// 3. Segments of no length and triangles without area count as the sets that they are.
///
/// The candidates are the points where the distance of the features' affine hulls is stationary
/// (C. Ericson, Real-Time Collision Detection, 2005, chapter 5), kept when they fall strictly
/// inside the features: every sign an integer's. Pure; no allocation. A few hundred nanoseconds for
/// points and segments, microseconds for triangles; meshes have part_pair.hpp.
[[nodiscard]] ClosestPoints closest_points(const Vec3l& a, const Vec3l& b);
[[nodiscard]] ClosestPoints closest_points(const Vec3l& a, const Segment& b);
[[nodiscard]] ClosestPoints closest_points(const Vec3l& a, const TriangleCorners& b);
[[nodiscard]] ClosestPoints closest_points(const Segment& a, const Segment& b);
[[nodiscard]] ClosestPoints closest_points(const Segment& a, const TriangleCorners& b);
[[nodiscard]] ClosestPoints closest_points(const TriangleCorners& a, const TriangleCorners& b);
/// Takes either shape by its corners, one to three: a point, a segment or a triangle.
[[nodiscard]] ClosestPoints closest_points(std::span<const Vec3l> a, std::span<const Vec3l> b);

/// The closest point of a closed solid box that is not empty; a point inside is its own closest
/// point.
struct ClosestOnBox {
  SquaredDistance squared;
  Vec3l on_box;
  BoxFeatureMask place = 0;  ///< the faces that the point lies on
};
[[nodiscard]] ClosestOnBox closest_points(const Vec3l& p, const Box3l& box);

}  // namespace strake::geometry
