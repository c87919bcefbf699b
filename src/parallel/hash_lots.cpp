// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "strake/parallel/distinct.hpp"

namespace strake::parallel::detail {

namespace {

/// Hashes that one worker deals out at once.
constexpr std::size_t kHashesPerRun = 16384;

/// By lot.
using Counts = std::array<std::size_t, kDistinctLots>;

std::size_t lot_of(std::uint64_t hash) {
  static_assert(kDistinctLots == 64);
  return hash >> 58U;
}

}  // namespace

Result<HashLots> hash_lots(const Context& context, std::string_view name,
                           std::span<const std::uint64_t> hashes) {
  const Region runs{.name = name, .n = (hashes.size() + kHashesPerRun - 1) / kHashesPerRun};
  const auto run = [&](std::size_t r) {
    return hashes.subspan(r * kHashesPerRun,
                          std::min(kHashesPerRun, hashes.size() - r * kHashesPerRun));
  };
  Result<std::vector<Counts>> counts = transform(context, runs, [&](std::size_t r) {
    Counts of{};
    for (const std::uint64_t hash : run(r)) ++of[lot_of(hash)];
    return of;
  });
  if (!counts) return std::move(counts).error();
  Result<std::vector<std::uint32_t>> order = unset_slots<std::uint32_t>(hashes.size());
  if (!order) return std::move(order).error();
  HashLots lots{.order = std::move(*order)};
  // Lot by lot, run by run: where the items of each run go in each lot.
  std::size_t at = 0;
  for (std::size_t lot = 0; lot < kDistinctLots; ++lot) {
    lots.begin[lot] = at;
    for (Counts& of : *counts) at += std::exchange(of[lot], at);
  }
  lots.begin[kDistinctLots] = at;
  Status status = for_each(context, runs, [&](std::size_t r) {
    Counts next = (*counts)[r];
    std::size_t i = r * kHashesPerRun;
    for (const std::uint64_t hash : run(r))
      lots.order[next[lot_of(hash)]++] = static_cast<std::uint32_t>(i++);
  });
  if (!status) return std::move(status).error();
  return lots;
}

}  // namespace strake::parallel::detail
