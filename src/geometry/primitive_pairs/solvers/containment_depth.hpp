// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/primitive_pairs/shapes/interior_distance.hpp"
#include "geometry/primitive_pairs/solvers/primitive_operand.hpp"

namespace strake::geometry::primitive_pairs {

/// How deep a convex body lies wholly inside another; negative: it sticks out by that much. No body
/// lies deeper than this says: it is the least of the differences of supports over all directions
/// tried, which are the outer body's plane faces, where it is exact, and those that descent finds
/// on its curved one from starts all round the inner body.
[[nodiscard]] double containment_depth(const ConvexBody& inner, const ConvexBody& outer,
                                       const InteriorDistance& outer_field);

/// The same where either may be a torus: how deep the hulls of the inner one's arcs lie in the
/// other.
[[nodiscard]] double containment_depth(const PrimitiveOperand& inner,
                                       const PrimitiveOperand& outer);

}  // namespace strake::geometry::primitive_pairs
