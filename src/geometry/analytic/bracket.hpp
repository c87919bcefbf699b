// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/analytic/convex_gap.hpp"
#include "geometry/analytic/cutting_planes.hpp"
#include "strake/geometry/analytic_pair.hpp"

namespace strake::geometry::analytic {

/// d in a certain bracket. Where no overlap is shown (upper >= 0), it is the middle, but no depth;
/// otherwise the middle of a bracket as narrow as `tolerance`, and where the search could not close
/// it the depth that its points show.
[[nodiscard]] double shown(double lower, double upper, double tolerance);

/// Two that are not known to overlap, by the points of `gap`.
[[nodiscard]] AnalyticSeparation not_overlapping(const ConvexGap& gap, double lower, double upper);

/// Two that overlap at `depth.point`, certainly no deeper than `-lower`; d as shown(). Which way is
/// out is for the caller to say.
[[nodiscard]] AnalyticSeparation overlapping(const DeepestPoint& depth, double lower,
                                             double tolerance);

}  // namespace strake::geometry::analytic
