// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::model {

/// An end of a primitive in its own frame: where another member or pipe goes on.
struct PrimitiveEnd {
  geometry::Vec3d centre;
  geometry::Vec3d outward;  ///< the normal of the end's plane; of any length
};

/// Returns the ends of a primitive: the two end faces of a cylinder, a snout and a torus, those of
/// a pyramid along its height, the base of a dish, and the two faces at the ends of a box's longest
/// side, if one side is longer than the other two. An end that is a point or a ridge is none; a
/// sphere, a line and a full ring have none.
[[nodiscard]] std::vector<PrimitiveEnd> ends_of(const geometry::Primitive& primitive);

}  // namespace strake::model
