// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/deal.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::parallel {

/// Which of many items are equal.
struct Distinct {
  std::vector<std::uint32_t> of;     ///< by item: the number of its kind
  std::vector<std::uint32_t> first;  ///< by kind: the first item that is one, ascending
};

/// A hash for distinct() with one value more; begin with 0.
[[nodiscard]] constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9e3779b97f4a7c15ULL;
  return hash ^ hash >> 29U;
}

namespace detail {

/// Items are distinguished in so many lots, each by one worker, whatever the team.
inline constexpr std::size_t kDistinctLots = 64;
/// Items that a worker takes at once, at most. Between 1024 and 16'384 no difference can be seen
/// (decision 0073).
inline constexpr std::size_t kDistinctGrain = 4096;

/// The item at which a lot had to end.
struct LotFault {
  std::size_t item = std::numeric_limits<std::size_t>::max();
  std::optional<Error> error = {};
};

/// Item numbers by the lot that their hash puts them in, ascending within each.
using HashLots = Dealt<std::uint32_t, kDistinctLots>;

/// Deals items out to lots, run by run. Errors as in for_each.
[[nodiscard]] Result<HashLots> hash_lots(const Context& context, std::string_view name,
                                         std::span<const std::uint64_t> hashes);

}  // namespace detail

/// Finds items that are equal, so that each kind is worked on once. Fewer than 2^32 items.
///
///     const auto kinds = distinct(context, "equal pairs", n,
///         [&](std::size_t i) { return hash_of(pair[i]); },
///         [&](std::size_t i, std::size_t j) { return pair[i] == pair[j]; });
///     ... work on pair[kinds->first[k]], use it for all i with kinds->of[i] == k ...
///
/// `hash(i)` is any 64-bit hash that spreads its highest and its lowest bits, see mixed(); it
/// decides who is compared with whom, never the answer. `same(i, j)` is called for items of equal
/// hashes only. Both are called concurrently, by one worker for an item: hashes that are dear to
/// make are made before, by pieces. All regions have the one name. Errors as in for_each: that of
/// the lowest item whose hash cannot be made, or else of the lowest that cannot be compared.
template <class Hash, class Same>
[[nodiscard]] Result<Distinct> distinct(const Context& context, std::string_view name,
                                        std::size_t n, Hash&& hash, Same&& same) {
  detail::require_shareable<Hash, std::size_t>();
  detail::require_test<Same, std::size_t, std::size_t>();
  constexpr std::uint32_t kFree = 0xffffffffU;
  // Few items may be large ones.
  const Region items{
      .name = name, .n = n, .grain = std::clamp<std::size_t>(n / 256, 1, detail::kDistinctGrain)};
  auto hashes = transform(context, items, [&](std::size_t i) -> std::uint64_t { return hash(i); });
  if (!hashes) return std::move(hashes).error();
  Result<detail::HashLots> lots = detail::hash_lots(context, name, *hashes);
  if (!lots) return std::move(lots).error();
  Result<std::vector<std::uint32_t>> first_of = unset_slots<std::uint32_t>(n);
  if (!first_of) return std::move(first_of).error();
  std::vector<std::uint32_t>& first = *first_of;
  auto faults = slots<detail::LotFault>(detail::kDistinctLots);
  if (!faults) return std::move(faults).error();
  Status status =
      for_each(context, {.name = name, .n = detail::kDistinctLots}, [&](std::size_t lot) {
        const std::span<const std::uint32_t> of_lot = (*lots)[lot];
        std::vector<std::uint32_t> slots(std::bit_ceil(2 * of_lot.size() + 1), kFree);
        for (const std::uint32_t i : of_lot) {
          if (context.stop.stop_requested()) break;
          Status compared = detail::status_of(name, i, [&] {
            const std::uint64_t h = (*hashes)[i];
            const auto is_same = [&](std::uint32_t j) { return (*hashes)[j] == h && same(j, i); };
            std::size_t slot = h & (slots.size() - 1);
            while (slots[slot] != kFree && !is_same(slots[slot]))
              slot = (slot + 1) & (slots.size() - 1);
            if (slots[slot] == kFree) slots[slot] = i;
            first[i] = slots[slot];
          });
          if (compared) continue;
          (*faults)[lot] = {i, std::move(compared).error()};
          break;
        }
      });
  if (!status) return std::move(status).error();
  const auto fault = std::ranges::min_element(*faults, {}, &detail::LotFault::item);
  if (fault->error) return *std::move(fault->error);
  auto kinds =
      collect<std::uint32_t>(context, items, [&](std::size_t i, std::vector<std::uint32_t>& out) {
        if (first[i] == i) out.push_back(first[i]);
      });
  if (!kinds) return std::move(kinds).error();
  Result<std::vector<std::uint32_t>> of = unset_slots<std::uint32_t>(n);
  if (!of) return std::move(of).error();
  Distinct result{std::move(*of), std::move(*kinds)};
  const Region all_kinds{.name = name, .n = result.first.size(), .grain = detail::kDistinctGrain};
  status = for_each(context, all_kinds, [&](std::size_t k) {
    result.of[result.first[k]] = static_cast<std::uint32_t>(k);
  });
  if (!status) return std::move(status).error();
  status = for_each(context, items, [&](std::size_t i) {
    if (first[i] != i) result.of[i] = result.of[first[i]];
  });
  if (!status) return std::move(status).error();
  return result;
}

}  // namespace strake::parallel
