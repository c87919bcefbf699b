// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A triangle seen along the axis of integration: x and y span its projection, z is the height
/// above the floor. Coordinates are whole grid units about a corner of the pair's common box.
struct ProjectedTriangle {
  std::array<Vec3d, 3> corner;  ///< counter-clockwise as projected
  Vec3d lo, hi;
  double slope_x = 0, slope_y = 0;  ///< of its plane; off by a few ulp
  double sign = 0;                  ///< +1 faces up, -1 faces down, 0 is parallel to the axis

  ProjectedTriangle() = default;
  /// Takes the corners in the order of the part, which decides the sign; whole numbers below 2^33.
  explicit ProjectedTriangle(const std::array<Vec3l, 3>& corners);
};

/// ∫ max(min(z_a, z_b), 0) over the common part of the projections, and a bound on its error.
struct PrismIntegral {
  double value = 0, error = 0;
};

/// Returns the integral over two triangles, neither parallel to the axis.
[[nodiscard]] PrismIntegral prism_integral(const ProjectedTriangle& a, const ProjectedTriangle& b);

}  // namespace strake::geometry
