// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "clash/candidate.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/heavy.hpp"

namespace strake::clash {

/// The cases of a run as work for a team. Each is done once, about the first pair that is one.
class CaseWork {
 public:
  /// Items per block of what takes a pair some time: small enough that a heavy one holds up few
  /// others.
  static constexpr std::size_t kGrain = 8;
  /// Items per block where each is done in no time.
  static constexpr std::size_t kBlock = 4096;
  /// Triangles of a part, or of two, that are worth a whole team.
  static constexpr double kHeavy = 1 << 16;

  CaseWork(const PartList& list, std::span<const geometry::IndexPair> pairs, const Cases& cases,
           const parallel::Context& context)
      : list_(list), pairs_(pairs), cases_(cases), context_(context) {}

  [[nodiscard]] const parallel::Context& context() const { return context_; }
  [[nodiscard]] std::size_t size() const { return cases_.first.size(); }
  [[nodiscard]] const PartRef& a(std::size_t i) const { return list_.parts[pair(i).first]; }
  [[nodiscard]] const PartRef& b(std::size_t i) const { return list_.parts[pair(i).second]; }
  [[nodiscard]] std::size_t triangles(std::size_t i) const {
    return a(i).placed.part->triangles.size() + b(i).placed.part->triangles.size();
  }

  /// Which unique parts some of the cases are about.
  [[nodiscard]] std::vector<bool> parts_of(std::span<const std::size_t> some) const {
    std::vector<bool> parts(list_.unique.size(), false);
    for (const std::size_t i : some) parts[a(i).unique] = parts[b(i).unique] = true;
    return parts;
  }

  /// The cases that pass a test, ascending. Errors here and below: cancelled.
  template <class Test>
  [[nodiscard]] Result<std::vector<std::size_t>> that(std::string_view name, Test&& test) const {
    return parallel::collect<std::size_t>(context_, {.name = name, .n = size(), .grain = kBlock},
                                          [&](std::size_t i, std::vector<std::size_t>& out) {
                                            if (test(i)) out.push_back(i);
                                          });
  }

  /// Calls work(i, a, b) for some of the cases, those with most triangles first; one that nobody
  /// should wait for has the team to itself.
  template <class Work>
  [[nodiscard]] Status over(std::span<const std::size_t> some, std::string_view name,
                            std::size_t grain, Work&& work) const {
    return parallel::for_each_by_weight(
        context_, {.name = name, .n = some.size(), .grain = grain}, kHeavy,
        [&](std::size_t k) { return triangles(some[k]); },
        [&](std::size_t k) { work(some[k], a(some[k]), b(some[k])); });
  }

 private:
  [[nodiscard]] const geometry::IndexPair& pair(std::size_t i) const {
    return pairs_[cases_.first[i]];
  }

  const PartList& list_;
  std::span<const geometry::IndexPair> pairs_;
  const Cases& cases_;
  const parallel::Context& context_;
};

}  // namespace strake::clash
