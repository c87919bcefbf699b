// SPDX-License-Identifier: Apache-2.0
#include "clash/cases.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <numeric>
#include <utility>

#include "strake/parallel/collect.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

using geometry::IndexPair;
using geometry::Vec3l;

/// Pairs are told apart in so many lots, each by one worker, whatever the team.
constexpr std::size_t kLots = 64;
constexpr std::size_t kGrain = 4096;

class Finder {
 public:
  Finder(std::span<const IndexPair> pairs, const PartList& list,
         std::span<const CaseSettings> settings, const parallel::Context& context)
      : pairs_(pairs), list_(list), settings_(settings), context_(context) {}

  Result<Cases> run() {
    auto hashes =
        parallel::transform(context_, {.name = "hash pairs", .n = pairs_.size(), .grain = kGrain},
                            [&](std::size_t i) { return hash(i); });
    if (!hashes) return hashes.error();
    hashes_ = std::move(*hashes);
    sort_into_lots();
    first_.resize(pairs_.size());
    const Status status = parallel::for_each(context_, {.name = "equal pairs", .n = kLots},
                                             [&](std::size_t lot) { tell_apart(lot); });
    if (!status) return status.error();
    return numbered();
  }

 private:
  [[nodiscard]] Vec3l offset(std::size_t i) const {
    return list_.parts[pairs_[i].second].placed.origin - list_.parts[pairs_[i].first].placed.origin;
  }

  /// Any good hash does: it decides who is compared with whom, never the answer.
  [[nodiscard]] std::uint64_t hash(std::size_t i) const {
    const Vec3l at = offset(i);
    std::uint64_t h = 0;
    const auto mix = [&h](std::uint64_t value) {
      h = (h ^ value) * 0x9e3779b97f4a7c15ULL;
      h ^= h >> 29U;
    };
    mix((std::uint64_t{list_.parts[pairs_[i].first].unique} << 32U) |
        list_.parts[pairs_[i].second].unique);
    for (int k = 0; k < 3; ++k) mix(static_cast<std::uint64_t>(at[k]));
    mix(settings_[i].tolerances);
    mix(std::bit_cast<std::uint64_t>(settings_[i].contact_distance));
    return h;
  }

  [[nodiscard]] bool same(std::size_t i, std::size_t j) const {
    return hashes_[i] == hashes_[j] &&
           list_.parts[pairs_[i].first].unique == list_.parts[pairs_[j].first].unique &&
           list_.parts[pairs_[i].second].unique == list_.parts[pairs_[j].second].unique &&
           offset(i) == offset(j) && settings_[i] == settings_[j];
  }

  static std::size_t lot_of(std::uint64_t hash) { return hash >> 58U; }

  void sort_into_lots() {
    for (const std::uint64_t h : hashes_) ++begin_[lot_of(h) + 1];
    for (std::size_t lot = 0; lot < kLots; ++lot) begin_[lot + 1] += begin_[lot];
    order_.resize(hashes_.size());
    std::array<std::size_t, kLots + 1> next = begin_;
    for (std::size_t i = 0; i < hashes_.size(); ++i)
      order_[next[lot_of(hashes_[i])]++] = static_cast<std::uint32_t>(i);
  }

  /// The first equal pair of each pair of a lot; the lot is in the order of the pairs.
  void tell_apart(std::size_t lot) {
    constexpr std::uint32_t kFree = 0xffffffffU;
    const std::size_t count = begin_[lot + 1] - begin_[lot];
    std::vector<std::uint32_t> slots(std::bit_ceil(2 * count + 1), kFree);
    for (std::size_t k = begin_[lot]; k < begin_[lot + 1]; ++k) {
      const std::uint32_t i = order_[k];
      std::size_t slot = hashes_[i] & (slots.size() - 1);
      while (slots[slot] != kFree && !same(slots[slot], i)) slot = (slot + 1) & (slots.size() - 1);
      if (slots[slot] == kFree) slots[slot] = i;
      first_[i] = slots[slot];
    }
  }

  [[nodiscard]] Result<Cases> numbered() const {
    auto first = parallel::collect<std::uint32_t>(
        context_, {.name = "cases", .n = pairs_.size(), .grain = kGrain},
        [&](std::size_t i, std::vector<std::uint32_t>& out) {
          if (first_[i] == i) out.push_back(first_[i]);
        });
    if (!first) return first.error();
    Cases cases{.of = std::vector<std::uint32_t>(pairs_.size()), .first = std::move(*first)};
    for (std::size_t k = 0; k < cases.first.size(); ++k)
      cases.of[cases.first[k]] = static_cast<std::uint32_t>(k);
    const Status status = parallel::for_each(
        context_, {.name = "cases of pairs", .n = pairs_.size(), .grain = kGrain},
        [&](std::size_t i) {
          if (first_[i] != i) cases.of[i] = cases.of[first_[i]];
        });
    if (!status) return status.error();
    return cases;
  }

  std::span<const IndexPair> pairs_;
  const PartList& list_;
  std::span<const CaseSettings> settings_;
  const parallel::Context& context_;
  std::vector<std::uint64_t> hashes_;
  std::array<std::size_t, kLots + 1> begin_{};
  std::vector<std::uint32_t> order_;  ///< pairs, lot by lot
  std::vector<std::uint32_t> first_;  ///< by pair: the first that equals it
};

}  // namespace

Cases each_alone(std::size_t pairs) {
  Cases cases;
  cases.first.resize(pairs);
  std::iota(cases.first.begin(), cases.first.end(), 0U);
  cases.of = cases.first;
  return cases;
}

Result<Cases> find_cases(std::span<const IndexPair> pairs, const PartList& list,
                         std::span<const CaseSettings> settings, const parallel::Context& context) {
  return Finder(pairs, list, settings, context).run();
}

}  // namespace strake::clash
