// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/vec.hpp"

// Even samples of a list, and the Morton order of points.

namespace strake::geometry {

/// Returns number i of `count` items that are spread evenly over a list.
template <class List>
[[nodiscard]] const auto& sample(const List& list, std::size_t i, std::size_t count) {
  return list[i * list.size() / count];
}

/// Returns the lowest 21 bits of a number, each three positions from the next.
[[nodiscard]] constexpr std::uint64_t spread_bits_by_three(std::uint64_t x) {
  x &= 0x1fffffU;
  x = (x | x << 32U) & 0x1f00000000ffffU;
  x = (x | x << 16U) & 0x1f0000ff0000ffU;
  x = (x | x << 8U) & 0x100f00f00f00f00fU;
  x = (x | x << 4U) & 0x10c30c30c30c30c3U;
  x = (x | x << 2U) & 0x1249249249249249U;
  return x;
}

/// Returns the numbers 0 to n - 1 in an order in which points near each other mostly follow each
/// other: along a curve through all cells of a grid (Z-order, G. M. Morton 1966). `point(i)`:
/// finite.
template <class Point>
[[nodiscard]] std::vector<std::uint32_t> morton_order(std::size_t n, const Point& point) {
  auto box = empty_box<double>();
  for (std::size_t i = 0; i < n; ++i) box.include(point(i));
  double longest = 0;
  for (int k = 0; k < 3 && n > 0; ++k) longest = std::max(longest, box.hi[k] - box.lo[k]);
  const double cells = longest > 0 ? 0x1p21 * (1 - 0x1p-30) / longest : 0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d cell = (point(i) - box.lo) * cells;
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k)
      key |= spread_bits_by_three(static_cast<std::uint64_t>(cell[k])) << static_cast<unsigned>(k);
    keys[i] = {key, static_cast<std::uint32_t>(i)};
  }
  std::ranges::sort(keys);
  std::vector<std::uint32_t> order(n);
  std::ranges::transform(keys, order.begin(), [](const auto& key) { return key.second; });
  return order;
}

}  // namespace strake::geometry
