// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "strake/geometry/part.hpp"

namespace strake::model {

/// An end of a mesh on the grid, relative to the origin of its body.
struct MeshEnd {
  geometry::Vec3l centre;
  geometry::Vec3d outward;  ///< a unit vector
  double reach = 0;         ///< reach_behind() of its part
};

/// Returns how far a part extends behind a plane, along its unit normal; 0 if nothing is behind it.
[[nodiscard]] double reach_behind(const geometry::Part& part, const geometry::Vec3l& at,
                                  const geometry::Vec3d& normal);

/// Returns the ends of a faceted pipe, as far as a mesh tells them: of a solid, its plane faces
/// that a circle bounds, with concentric circles in them as the cap of a tube has; of an open
/// surface, the circles that it ends in. A circle has six corners at least, all of them off one by
/// no more than a hundredth of its radius and `off` grid units, and no gap of a sixth of the way
/// round or more. Other outlines are no ends: a rectangle is as well the side of a beam.
[[nodiscard]] std::vector<MeshEnd> ends_of(const geometry::Part& part, double off);

}  // namespace strake::model
