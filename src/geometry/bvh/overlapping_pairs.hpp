// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/bvh/scene_bvh.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/allowance.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::geometry {

/// Whether one of two items belongs to set A and the other to set B.
[[nodiscard]] inline bool sets_match(std::uint8_t x, std::uint8_t y) {
  return ((x & kSetA) != 0 && (y & kSetB) != 0) || ((x & kSetB) != 0 && (y & kSetA) != 0);
}

[[nodiscard]] Error too_many(const parallel::Allowance& allowed);

/// Sorts pairs in ascending order. Errors: cancelled.
[[nodiscard]] Status sort_pairs(std::vector<IndexPair>& pairs, const parallel::Context& context);

/// Returns the pairs of A and B of different owners for which `meet(i, j)` holds, by the nested
/// loop.
template <class Meet>
[[nodiscard]] Result<std::vector<IndexPair>> all_pairs_that(std::span<const BoxItem> items,
                                                            const Meet& meet,
                                                            const parallel::Context& context,
                                                            std::uint64_t limit) {
  parallel::Allowance allowance(limit);
  std::vector<std::uint32_t> in_a, in_b;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].box.empty()) continue;
    if ((items[i].sets & kSetA) != 0) in_a.push_back(static_cast<std::uint32_t>(i));
    if ((items[i].sets & kSetB) != 0) in_b.push_back(static_cast<std::uint32_t>(i));
  }
  const auto both_ways = [&](std::uint32_t a, std::uint32_t b) {
    return (items[b].sets & kSetA) != 0 && (items[a].sets & kSetB) != 0;
  };
  const std::size_t cells = in_a.size() * in_b.size();
  auto pairs = parallel::collect<IndexPair>(
      context, {.name = "broad phase, all pairs", .n = cells, .grain = std::size_t{1} << 16U},
      [&](std::size_t cell, std::vector<IndexPair>& out) -> Status {
        const std::uint32_t a = in_a[cell / in_b.size()], b = in_b[cell % in_b.size()];
        if (items[a].owner == items[b].owner || !meet(a, b)) return {};
        if (a > b && both_ways(a, b)) return {};
        if (!allowance.take(1)) return too_many(allowance);
        out.push_back({std::min(a, b), std::max(a, b)});
        return {};
      });
  if (!pairs) return pairs.error();
  if (const Status s = sort_pairs(*pairs, context); !s) return s.error();
  return pairs;
}

}  // namespace strake::geometry
