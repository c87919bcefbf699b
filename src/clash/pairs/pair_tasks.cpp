// SPDX-License-Identifier: Apache-2.0
#include "clash/pairs/pair_tasks.hpp"

#include <bit>
#include <cstddef>
#include <numeric>

namespace strake::clash {

UniquePairs all_unique(std::size_t pairs) {
  UniquePairs unique_pairs;
  unique_pairs.first.resize(pairs);
  std::iota(unique_pairs.first.begin(), unique_pairs.first.end(), 0U);
  unique_pairs.of = unique_pairs.first;
  return unique_pairs;
}

Result<UniquePairs> find_unique_pairs(std::span<const geometry::IndexPair> pairs,
                                      const ScenePartList& list,
                                      std::span<const PairToleranceKey> settings,
                                      const parallel::Context& context) {
  using parallel::mixed;
  const auto a = [&](std::size_t i) -> const ScenePart& { return list.parts[pairs[i].first]; };
  const auto b = [&](std::size_t i) -> const ScenePart& { return list.parts[pairs[i].second]; };
  const auto offset = [&](std::size_t i) { return b(i).placed.origin - a(i).placed.origin; };
  return parallel::distinct(
      context, "equal pairs", pairs.size(),
      [&](std::size_t i) {
        const geometry::Vec3l at = offset(i);
        std::uint64_t h = mixed(0, (std::uint64_t{a(i).unique} << 32U) | b(i).unique);
        for (int k = 0; k < 3; ++k) h = mixed(h, static_cast<std::uint64_t>(at[k]));
        h = mixed(h, settings[i].tolerances);
        h = mixed(h, settings[i].may_be_allowed ? 1 : 0);
        h = mixed(h, std::bit_cast<std::uint64_t>(settings[i].snap));
        h = mixed(h, std::bit_cast<std::uint64_t>(settings[i].added_clearance_mm));
        return mixed(h, std::bit_cast<std::uint64_t>(settings[i].contact_distance));
      },
      [&](std::size_t i, std::size_t j) {
        return a(i).unique == a(j).unique && b(i).unique == b(j).unique && offset(i) == offset(j) &&
               settings[i] == settings[j];
      });
}

}  // namespace strake::clash
