// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "strake/parallel/for_each.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/team.hpp"

namespace strake::parallel {

/// The items that are too heavy to be one worker's, ascending: those that cost at least `least` and
/// would keep one worker busy while the others wait, however the rest is shared out. There are
/// fewer than two per worker; none for one worker.
[[nodiscard]] std::vector<std::uint32_t> heavy_items(std::span<const double> costs, double least,
                                                     unsigned workers);

/// As for_each, for items of very unequal cost of which the heavy ones can use a team themselves.
///
///     const Status status = for_each_by_weight(
///         context, {.name = "trees", .n = parts.size()}, 65536,
///         [&](std::size_t i) { return parts[i].triangles.size(); },
///         [&](std::size_t i) { trees[i] = Tree(parts[i], context); });
///
/// Heavy items (see heavy_items) run first, one after the other on the calling thread, so that the
/// team is free for the regions that they open; then the others as blocks, those that cost most
/// first. A region that one of those opens finds the team busy and runs alone. `cost(i)` is an
/// estimate in any unit; `least` is a cost, in the same unit, that is worth a team. Region::order
/// must be empty.
///
/// 1. Which items are apart depends on the size of the team, and must not show in a result: what an
///    item does may depend on its own size only.
/// 2. Errors and the stop token as in for_each, heavy items before the others.
template <class Cost, class Body>
[[nodiscard]] Status for_each_by_weight(const Context& context, const Region& region, double least,
                                        Cost&& cost, Body&& body) {
  std::vector<double> costs(region.n);
  for (std::size_t i = 0; i < region.n; ++i) costs[i] = static_cast<double>(cost(i));
  const std::vector<std::uint32_t> apart =
      heavy_items(costs, least, context.team == nullptr ? 1 : context.team->size());
  for (const std::uint32_t i : apart) {
    const Status status = for_each(context, {.name = region.name, .n = 1},
                                   [&](std::size_t /*only*/) { return body(std::size_t{i}); });
    if (!status) return status;
  }
  std::vector<std::uint32_t> rest;
  rest.reserve(region.n - apart.size());
  for (std::uint32_t i = 0, k = 0; i < region.n; ++i) {
    if (k < apart.size() && apart[k] == i)
      ++k;
    else
      rest.push_back(i);
  }
  Region others = region;
  others.n = rest.size();
  const std::vector<std::uint32_t> order = longest_first(others.blocks(), [&](std::size_t block) {
    const std::size_t first = block * others.block_size();
    double sum = 0;
    for (std::size_t k = first; k < std::min(others.n, first + others.block_size()); ++k)
      sum += costs[rest[k]];
    return sum;
  });
  others.order = order;
  return for_each(context, others, [&](std::size_t k) { return body(std::size_t{rest[k]}); });
}

}  // namespace strake::parallel
