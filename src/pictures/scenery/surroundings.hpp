// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "pictures/scenery/clash_place.hpp"
#include "pictures/viewpoint.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::pictures {

/// A triangle near a clash, mm from a point of the model.
struct NearTriangle {
  std::array<geometry::Vec3d, 3> at;
  Role role = Role::other;
  bool solid = true;  ///< of a body that has an inside: its back shows only where it is cut
};

/// Returns the triangles that meet a cube round a point of the grid, `half_mm` to each side; what
/// is transparent and not of the clash is left out. They come by body, part and number.
[[nodiscard]] std::vector<NearTriangle> triangles_near(const Scenery& scenery, const Roles& roles,
                                                       const geometry::Vec3l& point,
                                                       double half_mm);

}  // namespace strake::pictures
