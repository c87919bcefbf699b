// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"

// Exact normals of grid triangles, and the exact test for triangles without area.

namespace strake::geometry {

/// A normal without rounding, in the compiler's 128-bit integers: for a part within ±2^30 units it
/// needs 65 bits.
using ExactNormal = std::array<Int128, 3>;

/// Returns the exact dot product of a normal with a direction.
[[nodiscard]] constexpr Int128 along(const ExactNormal& n, const Vec3l& d) {
  return n[0] * d.x + n[1] * d.y + n[2] * d.z;
}

/// Returns the exact cross product.
[[nodiscard]] constexpr ExactNormal wide_cross(const Vec3l& a, const Vec3l& b) {
  const auto minor = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
    return static_cast<Int128>(p) * s - static_cast<Int128>(q) * r;
  };
  return {minor(a.y, a.z, b.y, b.z), minor(a.z, a.x, b.z, b.x), minor(a.x, a.y, b.x, b.y)};
}

/// Returns twice the area vector of a triangle of a part: outward for solids.
[[nodiscard]] inline ExactNormal triangle_normal(const Part& part, std::uint32_t triangle) {
  const Triangle& t = part.triangles[triangle];
  const Vec3l p = part.vertices[t[0]].as<std::int64_t>();
  return wide_cross(part.vertices[t[1]].as<std::int64_t>() - p,
                    part.vertices[t[2]].as<std::int64_t>() - p);
}

/// Whether a triangle has exactly no area. `Wide` holds the square of twice the extent of the mesh.
/// It has no branches: in coordinate planes some components are always zero, which makes branches
/// unpredictable.
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
