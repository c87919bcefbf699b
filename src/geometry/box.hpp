// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <ranges>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// The box of points; empty where there are none.
template <std::ranges::contiguous_range Points>
[[nodiscard]] auto box_of(const Points& points) {
  auto box = empty_box<decltype(std::ranges::range_value_t<Points>::x)>();
  for (const auto& p : points) box.include(p);
  return box;
}

/// Twice the centre of a box along an axis: exact.
[[nodiscard]] inline std::int64_t twice_centre(const Box3i& box, int axis) {
  return std::int64_t{box.lo[axis]} + box.hi[axis];
}

/// What the surface area heuristic weighs the nodes of a tree by.
[[nodiscard]] inline double half_area(const Box3i& box) {
  const Vec3d d = box.hi.as<double>() - box.lo.as<double>();
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

/// Squared distance of two boxes that are not empty; zero where they meet. Exact but for the
/// rounding of differences and squares.
[[nodiscard]] inline double squared_gap(const Box3d& x, const Box3d& y) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double gap = std::max(std::max(x.lo[k] - y.hi[k], y.lo[k] - x.hi[k]), 0.0);
    sum += gap * gap;
  }
  return sum;
}
[[nodiscard]] inline double squared_gap(const Vec3d& p, const Box3d& box) {
  return squared_gap(Box3d{p, p}, box);
}

}  // namespace strake::geometry
