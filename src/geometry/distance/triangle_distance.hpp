// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "geometry/bvh/pair_local_part.hpp"
#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/rational.hpp"
#include "strake/geometry/vec.hpp"

// The distance of two triangles: certified bounds in doubles, and exact.

namespace strake::geometry {

/// Certified bounds on the squared distance of two triangles.
struct DistanceBounds {
  double lower = 0, upper = 0;
};

/// A triangle in doubles (exact: grid coordinates of a pair fit 33 bits), prepared for many tests.
struct DoubleTriangle {
  std::array<Vec3d, 3> corner;
  Box3d box;
  Vec3d normal;
  double normal_squared = 0;
  double low = 0, high = 0;  ///< range of normal · corner
  double size = 0;           ///< largest absolute coordinate

  DoubleTriangle() = default;
  explicit DoubleTriangle(const TriangleCorners& t);
};

/// Returns bounds in double arithmetic. The lower one comes from a slab between the triangles, so
/// it holds however wrong the guess of the nearest features. Once the lower bound is above
/// `cutoff`, the upper one is not computed and is infinite; once the upper one is at most
/// `near_enough`, neither is improved.
[[nodiscard]] DistanceBounds triangle_distance_bounds(const DoubleTriangle& a,
                                                      const DoubleTriangle& b, double cutoff,
                                                      double near_enough = -1);

/// The nearest points of two triangles; among equal distances the pair of features that comes
/// first: vertex-vertex, vertex-edge, edge-vertex, vertex-face, face-vertex, edge-edge.
struct NearestTrianglePoints {
  SquaredDistance squared;
  Vec3d on_a, on_b;
  /// A direction w across which the triangles lie `width` apart, width²/w² being the squared
  /// distance; zero where its numbers are too large (a vertex nearest to an edge, far apart).
  Vec3<Int128> direction;
  Int128 width = 0;
};

/// Whether the triangles are certainly not nearer than a pair with this direction and width: cheap
/// and exact, and all that is needed for the many equal distances of parallel faces.
[[nodiscard]] bool not_nearer(const TriangleCorners& a, const TriangleCorners& b,
                              const NearestTrianglePoints& than);

/// Returns the exact distance for coordinates whose differences are at most 2^31; zero when the
/// triangles meet. `upper` bounds the squared distance from above, as triangle_distance_bounds()
/// gives it.
[[nodiscard]] NearestTrianglePoints exact_triangle_distance(const TriangleCorners& a,
                                                            const TriangleCorners& b, double upper);

/// Returns the nearest points of two triangles, given by their numbers, as a ClosestPair.
[[nodiscard]] inline ClosestPair as_closest_pair(const NearestTrianglePoints& nearest,
                                                 const NodePair& triangles) {
  ClosestPair close;
  close.squared = ratio_to_double(nearest.squared.numerator, nearest.squared.denominator);
  close.distance = sqrt_ratio_to_double(nearest.squared.numerator, nearest.squared.denominator);
  close.lower = close.distance;
  close.on_a = nearest.on_a;
  close.on_b = nearest.on_b;
  close.triangle_a = triangles.a;
  close.triangle_b = triangles.b;
  return close;
}

}  // namespace strake::geometry
