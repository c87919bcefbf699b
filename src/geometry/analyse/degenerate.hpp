// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// Whether a triangle has exactly no area. `Wide` holds the square of twice the extent of the
/// mesh. No branches: in a plane of two axes some components are always zero, and no two of them
/// alike.
template <class Wide>
[[nodiscard]] bool collinear(const Vec3i& a, const Vec3i& b, const Vec3i& c) {
  const Wide ux = Wide{b.x} - a.x, uy = Wide{b.y} - a.y, uz = Wide{b.z} - a.z;
  const Wide vx = Wide{c.x} - a.x, vy = Wide{c.y} - a.y, vz = Wide{c.z} - a.z;
  return ((uy * vz - uz * vy) | (uz * vx - ux * vz) | (ux * vy - uy * vx)) == 0;
}

/// Whether coordinates in this box differ by less than 2^30: then 64-bit products suffice for
/// collinear().
[[nodiscard]] inline bool is_narrow(const Box3i& box) {
  bool narrow = true;
  for (int k = 0; k < 3; ++k)
    narrow = narrow && std::int64_t{box.hi[k]} - box.lo[k] < (std::int64_t{1} << 30U);
  return narrow;
}

}  // namespace strake::geometry
