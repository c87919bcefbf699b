// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {

[[nodiscard]] inline int sign_of(Int128 v) { return (v > 0) - (v < 0); }

/// An axis along which a vector does not vanish, or -1.
[[nodiscard]] inline int any_axis(const Vec3<Int128>& v) {
  return v.x != 0 ? 0 : v.y != 0 ? 1 : v.z != 0 ? 2 : -1;
}

/// The corner after corner i of a triangle.
[[nodiscard]] constexpr std::size_t next(std::size_t i) { return i == 2 ? 0 : i + 1; }

/// The corner or edge of a triangle on whose lines a point of it lies, or its inside: bit i of
/// `on_edges` is set when it is on edge i.
[[nodiscard]] inline PlaceMask place_of(unsigned on_edges) {
  PlaceMask place = 7;
  for (unsigned i = 0; i < 3; ++i)
    if ((on_edges >> i & 1U) != 0) place &= static_cast<PlaceMask>((1U << i) | (1U << next(i)));
  return place;
}

}  // namespace strake::geometry
