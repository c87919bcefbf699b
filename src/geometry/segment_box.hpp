// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// Whether a segment may meet a box; false is certain. By the slabs of the box and the axes square
/// to the segment and one of its sides (separating axes).
[[nodiscard]] inline bool may_meet(const Vec3d& from, const Vec3d& to, const Box3d& box) {
  const Vec3d centre = (box.lo + box.hi) * 0.5, half = (box.hi - box.lo) * 0.5;
  const Vec3d middle = (from + to) * 0.5 - centre, along = (to - from) * 0.5;
  const Vec3d reach{std::fabs(along.x), std::fabs(along.y), std::fabs(along.z)};
  for (int k = 0; k < 3; ++k)
    if (std::fabs(middle[k]) > half[k] + reach[k]) return false;
  const Vec3d across = cross(along, middle);
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double most = half[i] * reach[j] + half[j] * reach[i];
    const double rounding =
        1e-12 * (most + std::fabs(along[i] * middle[j]) + std::fabs(along[j] * middle[i]));
    if (std::fabs(across[k]) > most + rounding) return false;
  }
  return true;
}

}  // namespace strake::geometry
