// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/corners.hpp"
#include "geometry/directions.hpp"

namespace strake::geometry {

/// By what angle, in radians, the snap of its corners may have turned a triangle with this normal
/// (not a unit one): two grid units in its width. Needles of one flat face look many ways.
[[nodiscard]] inline double snap_tilt(const Corners& t, const Vec3d& normal) {
  constexpr double kUnits = 2;
  const double longest = std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
  return kUnits * longest / length(normal);
}

}  // namespace strake::geometry
