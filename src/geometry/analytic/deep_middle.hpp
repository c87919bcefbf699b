// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/analytic/convex_gap.hpp"
#include "geometry/analytic/inner_field.hpp"

namespace strake::geometry::analytic {

/// A convex body and its inside.
struct MeasuredBody {
  const ConvexBody& body;
  const InnerField& field;
};

/// From a point in both, `depth` deep in the first, towards the middle of the points that are and
/// as deep: along one direction after another that either body is measured along, square to the
/// skin nearest to the point. The answer is in both and as deep but for a thousandth of a grid
/// unit.
[[nodiscard]] Vec3d middle_of_deep(const MeasuredBody& deep, const MeasuredBody& room,
                                   const Vec3d& from, double depth);

}  // namespace strake::geometry::analytic
