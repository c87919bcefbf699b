// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

#include "pictures/viewpoint.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::pictures {

[[nodiscard]] inline geometry::Vec3d unit(const geometry::Vec3d& v) {
  return v * (1 / std::sqrt(dot(v, v)));
}

/// The axes of a view: of length one, square to each other; to the right, up and to the viewer.
struct Axes {
  geometry::Vec3d right, up, toward;

  /// Returns the axes of a view towards a viewer, with z up, or y where the view is along z.
  [[nodiscard]] static Axes towards(const geometry::Vec3d& viewer) {
    const geometry::Vec3d to = unit(viewer);
    const bool plan = to.x == 0 && to.y == 0;
    return with_up(to, plan ? geometry::Vec3d{0, 1, 0} : geometry::Vec3d{0, 0, 1});
  }
  [[nodiscard]] static Axes of(const ClashViewpoint& viewpoint) {
    return with_up(unit(-viewpoint.direction), viewpoint.up);
  }

 private:
  [[nodiscard]] static Axes with_up(const geometry::Vec3d& toward, const geometry::Vec3d& up) {
    const geometry::Vec3d right = unit(cross(up, toward));
    return {right, cross(toward, right), toward};
  }
};

/// Returns the grid point of a viewpoint's target, about which pictures reckon.
[[nodiscard]] inline geometry::Vec3l grid_point(const geometry::Vec3d& mm) {
  const auto snapped = geometry::snap(mm);
  return snapped ? *snapped : geometry::Vec3l{};
}

}  // namespace strake::pictures
