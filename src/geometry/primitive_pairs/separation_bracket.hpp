// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/primitive_pairs/solvers/convex_depth.hpp"
#include "geometry/primitive_pairs/solvers/gjk.hpp"
#include "strake/geometry/primitive_separation.hpp"

namespace strake::geometry::primitive_pairs {

/// Returns d for a certain bracket: the middle of one on one side of a touch, 0 where it is open
/// whether the two are apart or overlap. The bracket of two that overlap counts as closed where it
/// is as narrow as `tolerance`; where the search could not close it, d is the depth of the points
/// found.
[[nodiscard]] double nominal_separation(double lower, double upper, double tolerance);

/// Returns the separation of two bodies that are not known to overlap, by the points of `gap`.
[[nodiscard]] PrimitiveSeparation disjoint_separation(const GjkResult& gap, double lower,
                                                      double upper);

/// Returns the separation of two bodies that overlap at `depth.point`, certainly no deeper than
/// `-lower`; d as by nominal_separation(). The caller sets the direction out.
[[nodiscard]] PrimitiveSeparation overlapping_separation(const DeepestPoint& depth, double lower,
                                                         double tolerance);

}  // namespace strake::geometry::primitive_pairs
