// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "strake/geometry/vec.hpp"

namespace strake::geometry::primitive_pairs {

/// The body q(y) <= 0 of a quadric, q(y) = sum of m·y² + 2·b·y over three axes, + c, with the
/// largest m equal to 1: an ellipsoid, an infinite cylinder or, where one m is negative, a double
/// cone, each under any affine map.
struct Quadric {
  Vec3d centre;               ///< y is measured from here, grid units
  std::array<Vec3d, 3> axes;  ///< orthonormal
  Vec3d m, b;
  double c = 0;
  double noise = 0;  ///< relative: roundings of q are at most this times the squares of lengths
};

/// The quadric of |p·y|² + |q·y|² + sign·|r·y + s|² + c, as forms of y.
struct QuadricForms {
  Vec3d p, q, r;
  double sign = 1, s = 0, c = 0;
  double noise = 0;  ///< see Quadric
};
[[nodiscard]] Quadric make_quadric(const Vec3d& centre, const QuadricForms& forms);

/// Where a quadric's surface lies nearest to a point.
struct QuadricDepth {
  double depth = 0;    ///< distance, negative outside
  double certain = 0;  ///< the ball of this radius about the point certainly lies in the body
  Vec3d normal;        ///< unit, outward
};

/// Returns the depth by the root of the secular equation. Inside, weak duality makes every
/// multiplier a certain bound (Pólik and Terlaky, A survey of the S-lemma, 2007). `reach` bounds
/// the lengths that matter.
[[nodiscard]] QuadricDepth quadric_depth(const Quadric& quadric, const Vec3d& point, double reach);

}  // namespace strake::geometry::primitive_pairs
