// SPDX-License-Identifier: Apache-2.0
#include "strake/parallel/order.hpp"

#include <algorithm>
#include <numeric>

namespace strake::parallel {

std::vector<std::uint32_t> longest_first(std::span<const double> costs) {
  std::vector<std::uint32_t> order(costs.size());
  std::iota(order.begin(), order.end(), 0U);
  // NaN compares false with everything, which is no order: it is given a place of its own.
  const auto cost = [&](std::uint32_t i) { return costs[i] > 0 ? costs[i] : 0.0; };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return cost(a) != cost(b) ? cost(a) > cost(b) : a < b;
  });
  return order;
}

}  // namespace strake::parallel
