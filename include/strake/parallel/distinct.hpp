// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/parallel/collect.hpp"
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

/// Items are told apart in so many lots, each by one worker, whatever the team.
inline constexpr std::size_t kDistinctLots = 64;

/// Item numbers by the lot that their hash puts them in, ascending within each.
struct HashLots {
  std::array<std::size_t, kDistinctLots + 1> begin{};
  std::vector<std::uint32_t> order;

  explicit HashLots(const std::vector<std::uint64_t>& hashes) : order(hashes.size()) {
    for (const std::uint64_t h : hashes) ++begin[of(h) + 1];
    for (std::size_t lot = 0; lot < kDistinctLots; ++lot) begin[lot + 1] += begin[lot];
    std::array<std::size_t, kDistinctLots + 1> next = begin;
    for (std::size_t i = 0; i < hashes.size(); ++i)
      order[next[of(hashes[i])]++] = static_cast<std::uint32_t>(i);
  }

  static std::size_t of(std::uint64_t hash) { return hash >> 58U; }
};

/// Errors: out of memory.
[[nodiscard]] inline Result<HashLots> hash_lots(const std::vector<std::uint64_t>& hashes) {
  try {
    return HashLots(hashes);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

}  // namespace detail

/// Finds items that are equal, so that each kind is worked on once. Fewer than 2^32 items.
///
///     const auto kinds = distinct(context, "equal pairs", n,
///         [&](std::size_t i) { return hash_of(pair[i]); },
///         [&](std::size_t i, std::size_t j) { return pair[i] == pair[j]; });
///     ... work on pair[kinds->first[k]], use it for all i with kinds->of[i] == k ...
///
/// `hash(i)` is any 64-bit hash that spreads its highest and its lowest bits, see mixed(); it
/// decides who is compared with whom, never the answer. `same(i, j)` is asked for items of equal
/// hashes only. Both are called concurrently. All regions have the one name. Errors as in for_each.
template <class Hash, class Same>
[[nodiscard]] Result<Distinct> distinct(const Context& context, std::string_view name,
                                        std::size_t n, Hash&& hash, Same&& same) {
  constexpr std::size_t kGrain = 4096;
  constexpr std::uint32_t kFree = 0xffffffffU;
  const Region items{.name = name, .n = n, .grain = kGrain};
  const auto hashes =
      transform(context, items, [&](std::size_t i) -> std::uint64_t { return hash(i); });
  if (!hashes) return hashes.error();
  const Result<detail::HashLots> lots = detail::hash_lots(*hashes);
  if (!lots) return lots.error();
  Result<std::vector<std::uint32_t>> first_of = slots<std::uint32_t>(n);
  if (!first_of) return first_of.error();
  std::vector<std::uint32_t>& first = *first_of;
  Status status =
      for_each(context, {.name = name, .n = detail::kDistinctLots}, [&](std::size_t lot) -> Status {
        const std::size_t begin = lots->begin[lot], end = lots->begin[lot + 1];
        std::vector<std::uint32_t> slots(std::bit_ceil(2 * (end - begin) + 1), kFree);
        for (std::size_t k = begin; k < end; ++k) {
          const std::uint32_t i = lots->order[k];
          Status compared = detail::status_of(name, i, [&] {
            const std::uint64_t h = (*hashes)[i];
            const auto is_same = [&](std::uint32_t j) { return (*hashes)[j] == h && same(j, i); };
            std::size_t slot = h & (slots.size() - 1);
            while (slots[slot] != kFree && !is_same(slots[slot]))
              slot = (slot + 1) & (slots.size() - 1);
            if (slots[slot] == kFree) slots[slot] = i;
            first[i] = slots[slot];
          });
          if (!compared) return compared;
        }
        return {};
      });
  if (!status) return status.error();
  auto kinds =
      collect<std::uint32_t>(context, items, [&](std::size_t i, std::vector<std::uint32_t>& out) {
        if (first[i] == i) out.push_back(first[i]);
      });
  if (!kinds) return kinds.error();
  Result<std::vector<std::uint32_t>> of = slots<std::uint32_t>(n);
  if (!of) return of.error();
  Distinct result{std::move(*of), std::move(*kinds)};
  for (std::size_t k = 0; k < result.first.size(); ++k)
    result.of[result.first[k]] = static_cast<std::uint32_t>(k);
  status = for_each(context, items, [&](std::size_t i) {
    if (first[i] != i) result.of[i] = result.of[first[i]];
  });
  if (!status) return status.error();
  return result;
}

}  // namespace strake::parallel
