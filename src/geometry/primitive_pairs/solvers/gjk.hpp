// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "geometry/primitive_pairs/shapes/support_mapping.hpp"

namespace strake::geometry::primitive_pairs {

/// Grid units: a bracket of a distance this narrow ends the iteration.
inline constexpr double kGapTolerance = 1.0 / 64;

/// The distance of two convex sets: lower <= distance <= upper is certain.
struct GjkResult {
  /// Width of the slab found between the two; negative: how far they overlap along the direction
  /// that separates them best of those tried.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();  ///< how far on_a and on_b are apart
  Vec3d on_a, on_b;                                        ///< points of the two
  Vec3d normal;                                            ///< unit, from b to a: that of `lower`
  int steps = 0;
};

/// Returns the distance by Gilbert, Johnson and Keerthi (1988): the point of the Minkowski
/// difference a - b nearest to the origin, by simplices of support points. Every direction tried
/// gives a slab between the two, hence the lower bound; the points returned are convex combinations
/// of points of the bodies, hence the upper one. Both count their rounding and hold wherever the
/// iteration stops: at a bracket of kGapTolerance, at a lower bound of `cutoff`, or when doubles
/// bring no progress.
[[nodiscard]] GjkResult gjk_distance(const ConvexBody& a, const ConvexBody& b,
                                     double cutoff = std::numeric_limits<double>::infinity());

}  // namespace strake::geometry::primitive_pairs
