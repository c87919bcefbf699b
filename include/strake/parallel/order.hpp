// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace strake::parallel {

/// A visiting order for Region::order: heaviest first, ties by index (Graham's LPT rule, 1969:
/// at most 4/3 of the best possible time for any estimate that is right).
///
/// `costs` holds one estimate per block of the region (per item when grain is 1), in any unit;
/// even one that is off by a factor of two is worth it. They are distinguished as floats are; NaN
/// and what is below zero count as no cost at all. Fewer than 2^32; 8 ns for each.
[[nodiscard]] std::vector<std::uint32_t> longest_first(std::span<const double> costs);

/// The same with estimate(i) for i in [0, n).
template <class Estimate>
[[nodiscard]] std::vector<std::uint32_t> longest_first(std::size_t n, Estimate&& estimate) {
  std::vector<double> costs(n);
  for (std::size_t i = 0; i < n; ++i) costs[i] = static_cast<double>(estimate(i));
  return longest_first(costs);
}

}  // namespace strake::parallel
