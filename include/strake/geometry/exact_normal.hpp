// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {

/// A normal without rounding, in the 128-bit integer that the compiler has: of a part within ±2^30
/// units it needs 65 bits.
using NormalVector = std::array<Int128, 3>;

/// The exact dot product of a normal with a direction.
[[nodiscard]] constexpr Int128 along(const NormalVector& n, const Vec3l& d) {
  return n[0] * d.x + n[1] * d.y + n[2] * d.z;
}

/// The exact cross product.
[[nodiscard]] constexpr NormalVector wide_cross(const Vec3l& a, const Vec3l& b) {
  const auto minor = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
    return static_cast<Int128>(p) * s - static_cast<Int128>(q) * r;
  };
  return {minor(a.y, a.z, b.y, b.z), minor(a.z, a.x, b.z, b.x), minor(a.x, a.y, b.x, b.y)};
}

/// Twice the area vector of a triangle of a part: outward for solids.
[[nodiscard]] inline NormalVector triangle_normal(const Part& part, std::uint32_t triangle) {
  const Triangle& t = part.triangles[triangle];
  const Vec3l p = part.vertices[t[0]].as<std::int64_t>();
  return wide_cross(part.vertices[t[1]].as<std::int64_t>() - p,
                    part.vertices[t[2]].as<std::int64_t>() - p);
}

}  // namespace strake::geometry
