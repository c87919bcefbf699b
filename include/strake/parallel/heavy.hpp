// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "strake/parallel/executor.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/progress.hpp"
#include "strake/parallel/slots.hpp"

namespace strake::parallel {

/// The items that are too heavy to be one worker's, ascending: those that cost at least `least` and
/// with which some worker would take more than 9/8 of a fair share, the costs of all that is not
/// set apart yet over all workers, however these are shared out. There are fewer than two per
/// worker; none for one worker.
[[nodiscard]] std::vector<std::uint32_t> heavy_items(std::span<const double> costs, double least,
                                                     unsigned workers);

namespace detail {

/// The items of a region as for_each_by_weight runs them.
struct HeavySplit {
  std::vector<std::uint32_t> heavy, rest;  ///< ascending

  /// Leaves out what is light and not below an item.
  void drop_from(std::uint32_t item);
  /// A visiting order for a region of the rest, by the costs of all.
  [[nodiscard]] Result<std::vector<std::uint32_t>> longest_first(std::span<const double> costs,
                                                                 const Region& others) const;
};

/// Calls put(i), which keeps what item i of the region costs, for all of them.
template <class Put>
Status estimate(const Context& context, const Region& region, Put&& put) {
  // Costs are read off, mostly: a few thousand are not worth a team.
  constexpr std::size_t kGrain = 4096;
  Context silent = context;
  silent.progress = nullptr;  // it counts items that are done
  return for_each(
      silent, {.name = "costs of items", .n = region.n, .grain = kGrain, .alone_below = 2 * kGrain},
      [&](std::size_t i) { return status_of(region.name, i, [&] { put(i); }); });
}

[[nodiscard]] Result<HeavySplit> split_off_heavy(std::span<const double> costs, double least,
                                                 unsigned workers, const Region& region);

}  // namespace detail

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
/// must be empty. Results go to slots; values by key are made by Precomputed::fill_by_weight. Costs
/// are requested by all workers.
///
/// 1. Which items are apart depends on the size of the team, and must not show in a result: what an
///    item does may depend on its own size only.
/// 2. Errors and the stop token as in for_each: the error is that of the lowest failing item, heavy
///    or not. An exception of cost is an error, too.
/// 3. In a report heavy items are nested runs; the balance is that of the others.
template <class Cost, class Body>
[[nodiscard]] Status for_each_by_weight(const Context& context, const Region& region, double least,
                                        Cost&& cost, Body&& body) {
  detail::require_shareable<Body, std::size_t>();
  detail::require_shareable<Cost, std::size_t>();
  if (!region.order.empty()) return detail::order_given(region);
  if (region.is_short()) return for_each(context, region, body);
  if (context.stop.stop_requested()) return detail::cancelled_error();
  auto costs = unset_slots<double>(region.n);
  if (!costs) return std::move(costs).error();
  if (Status status = detail::estimate(
          context, region, [&](std::size_t i) { (*costs)[i] = static_cast<double>(cost(i)); });
      !status)
    return status;
  const bool alike = context.team == nullptr || context.distribution == Distribution::equal_ranges;
  const unsigned workers = alike ? 1 : context.team->size();
  auto apart = detail::split_off_heavy(*costs, least, workers, region);
  if (!apart) return std::move(apart).error();
  // One phase for all: what is inside a heavy item has none to show.
  const ProgressPhase phase(context.progress, region.name, region.n);
  Context inner = context;
  if (phase.is_ours()) inner.progress = nullptr;
  const auto run_one = [&](std::size_t i) {
    Status status = detail::status_of(region.name, i, [&] { return body(i); });
    phase.add(1);
    return status;
  };
  Status of_heavy;
  for (const std::uint32_t i : apart->heavy) {
    of_heavy = for_each(inner, {.name = region.name, .n = 1},
                        [&](std::size_t /*only*/) { return run_one(i); });
    if (of_heavy) continue;
    if (context.stop.stop_requested()) return detail::cancelled_error();
    apart->drop_from(i);  // those below may fail as well, and then are the ones to tell of
    break;
  }
  Region others = region;
  others.n = apart->rest.size();
  others.alone_below = 0;  // of all items, not of those that are left
  auto order = apart->longest_first(*costs, others);
  if (!order) return std::move(order).error();
  others.order = *order;
  Status status = for_each(inner, others, [&](std::size_t k) { return run_one(apart->rest[k]); });
  return status ? std::move(of_heavy) : std::move(status);
}

}  // namespace strake::parallel
