// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/primitive_pairs/shapes/interior_distance.hpp"
#include "geometry/primitive_pairs/solvers/primitive_operand.hpp"

namespace strake::geometry::primitive_pairs {

/// Returns how deep a convex body lies wholly inside another; negative where it protrudes by that
/// much. It is an upper bound: the least of the differences of supports over all directions tried,
/// which are the normals of the outer body's plane faces, where it is exact, and those that descent
/// finds on its curved face from starts all round the inner body.
[[nodiscard]] double containment_depth(const ConvexBody& inner, const ConvexBody& outer,
                                       const InteriorDistance& outer_field);

/// Returns the same where either may be a torus: the depth of the hulls of the inner one's arcs in
/// the other.
[[nodiscard]] double containment_depth(const PrimitiveOperand& inner,
                                       const PrimitiveOperand& outer);

}  // namespace strake::geometry::primitive_pairs
