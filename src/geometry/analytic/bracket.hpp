// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/analytic/convex_gap.hpp"
#include "geometry/analytic/cutting_planes.hpp"
#include "strake/geometry/analytic_pair.hpp"

namespace strake::geometry::analytic {

/// d in a certain bracket: the middle of one that lies on one side of a touch, 0 where it is open
/// whether the two are apart or overlap. The bracket of two that overlap counts as closed where it
/// is as narrow as `tolerance`; where the search could not close it, d is the depth that its points
/// show.
[[nodiscard]] double shown(double lower, double upper, double tolerance);

/// Two that are not known to overlap, by the points of `gap`.
[[nodiscard]] AnalyticSeparation not_overlapping(const ConvexGap& gap, double lower, double upper);

/// Two that overlap at `depth.point`, certainly no deeper than `-lower`; d as shown(). Which way is
/// out is for the caller to say.
[[nodiscard]] AnalyticSeparation overlapping(const DeepestPoint& depth, double lower,
                                             double tolerance);

}  // namespace strake::geometry::analytic
