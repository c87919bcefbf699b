// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "geometry/corners.hpp"
#include "geometry/directions.hpp"

namespace strake::geometry {

/// By what angle, in radians, the snap of its corners may have turned a triangle with this normal
/// (not a unit one): two grid units in its width. Needles of one flat face look many ways.
[[nodiscard]] inline double snap_tilt(const Corners& t, const Vec3d& normal) {
  constexpr double kUnits = 2;
  return kUnits * length(longest_edge(t)) / length(normal);
}

/// Whether two unit normals, either turned by up to so much, may be those of one flat face.
[[nodiscard]] inline bool may_be_one_face(const Vec3d& n, double tilt_n, const Vec3d& m,
                                          double tilt_m) {
  const Vec3d apart = n - m;
  const double tilt = tilt_n + tilt_m;
  return dot(apart, apart) <= tilt * tilt;
}

/// Triangles that the snap may have turned by more than this, in radians, may be needles of one
/// flat face, and the fewest that are worth while to be told as such.
inline constexpr double kNeedleTilt = 1.0 / 16384;
inline constexpr std::size_t kFewestNeedles = 32;

}  // namespace strake::geometry
