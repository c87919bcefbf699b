// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/analytic/inner_field.hpp"
#include "geometry/analytic/pair_side.hpp"

namespace strake::geometry::analytic {

/// How deep a convex body lies wholly inside another; negative: it sticks out by that much. No body
/// lies deeper than this says: it is the least of the differences of supports over all directions
/// tried, which are the outer body's plane faces, where it is exact, and those that descent finds
/// on its curved one from starts all round the inner body.
[[nodiscard]] double inside_by(const ConvexBody& inner, const ConvexBody& outer,
                               const InnerField& outer_field);

/// The same where either may be a torus: how deep the hulls of the inner one's arcs lie in the
/// other.
[[nodiscard]] double inside_by(const PairSide& inner, const PairSide& outer);

}  // namespace strake::geometry::analytic
