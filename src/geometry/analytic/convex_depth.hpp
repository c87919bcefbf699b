// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/analytic/inner_field.hpp"

namespace strake::geometry::analytic {

/// Grid units: the bracket of a depth is narrow enough.
inline constexpr double kDepthTolerance = 1.0 / 16;

/// A convex body with what is known of its inside.
struct DeepBody {
  const ConvexBody* body = nullptr;
  const InnerField* field = nullptr;
};

/// How deep a body is at the deepest of the points that lie in another: lower <= depth <= upper is
/// certain. Negative `upper`: the two are apart.
struct ConvexDepth {
  double lower = 0, upper = 0;
  Vec3d point;  ///< in both, `lower` deep in the first
  int steps = 0;
};

/// The greatest r for which a ball of that radius lies in `measured` with its centre in `room`: a
/// linear program in four variables over all the half-spaces of both. Cutting planes (Kelley 1960)
/// are found as they are needed and taken in by the dual simplex method; multipliers prove the
/// upper bound, and a point of `room` with its certain depth the lower one. Stops when they agree
/// to kDepthTolerance, or the upper one falls to `enough`.
[[nodiscard]] ConvexDepth deepest_in(const DeepBody& measured, const ConvexBody& room,
                                     double enough);

}  // namespace strake::geometry::analytic
