// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/analytic/convex_gap.hpp"
#include "geometry/analytic/cutting_planes.hpp"
#include "strake/geometry/analytic_pair.hpp"

namespace strake::geometry::analytic {

/// Two that are not known to overlap, by the points of `gap`: d is the middle of the certain
/// bracket, but no depth, which nothing has shown.
[[nodiscard]] AnalyticSeparation not_overlapping(const ConvexGap& gap, double lower, double upper);

/// Two that overlap at `depth.point`, certainly no deeper than `-lower`: d is the middle of a
/// bracket as narrow as `tolerance`, and what the point shows where the search could not close it.
/// Which way is out is for the caller to say.
[[nodiscard]] AnalyticSeparation overlapping(const DeepestPoint& depth, double lower,
                                             double tolerance);

}  // namespace strake::geometry::analytic
