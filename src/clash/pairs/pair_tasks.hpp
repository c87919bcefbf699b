// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/pairs/pair_result.hpp"
#include "geometry/bvh/scene_bvh.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/distinct.hpp"
#include "strake/parallel/heavy.hpp"

/// Unique pairs of parts, and the work on them.
namespace strake::clash {

/// The unique pairs among pairs of parts: those of equal geometry in equal relative position under
/// equal tolerances are one. A ship has its frames, brackets and pipe hangers a hundred thousand
/// times over.
using UniquePairs = parallel::Distinct;

/// Makes every pair a unique pair of its own.
[[nodiscard]] UniquePairs all_unique(std::size_t pairs);

/// What the result of a pair depends on, besides its parts.
struct PairToleranceKey {
  std::uint32_t tolerances = 0;
  double contact_distance = 0;
  double snap = 0;
  double added_clearance_mm = 0;  ///< by the objects of the pair
  /// Whether a rule may allow the result: then regions farther apart are looked for, too.
  bool may_be_allowed = false;
  friend bool operator==(const PairToleranceKey&, const PairToleranceKey&) = default;
};

/// Finds the unique pairs; `settings` has one key per pair. Errors: cancelled.
[[nodiscard]] Result<UniquePairs> find_unique_pairs(std::span<const geometry::IndexPair> pairs,
                                                    const ScenePartList& list,
                                                    std::span<const PairToleranceKey> settings,
                                                    const parallel::Context& context);

/// A unique pair of parts on its way through the engine.
struct Candidate {
  PairEvaluation evaluation;
  NarrowCost cost;
  PriorBounds known;
  bool done = false;
  bool too_large = false;
  bool in_open = false;  ///< one part lies within the other, which is open: see mark_enclosed()
};

/// Evaluates a candidate, with a team's help where it is heavy, and adds what it cost:
/// `evaluate(NarrowWork&)` returns the result.
template <class Evaluate>
auto with_cost(Candidate& candidate, const parallel::Context& team, Evaluate&& evaluate) {
  NarrowWork work;
  work.pair.team = &team;
  auto answer = evaluate(work);
  candidate.cost.add(work);
  return answer;
}

/// The pairs that went to the narrow phase, and what it found.
struct EvaluatedPairs {
  const ScenePartList& list;
  std::span<const geometry::IndexPair> pairs;
  const UniquePairs& unique_pairs;
  std::span<const Candidate> candidates;  ///< one per unique pair

  [[nodiscard]] const Candidate& of(std::size_t pair) const {
    return candidates[unique_pairs.of[pair]];
  }
  [[nodiscard]] const ScenePart& a(std::size_t pair) const { return list.parts[pairs[pair].first]; }
  [[nodiscard]] const ScenePart& b(std::size_t pair) const {
    return list.parts[pairs[pair].second];
  }
};

/// The unique pairs of a run as work for a team. Each is evaluated once, for its first pair.
class PairTasks {
 public:
  /// Items per block where a pair takes some time: so few that a heavy one holds up few others.
  /// Between 2 and 32 no difference can be seen (decision 0073).
  static constexpr std::size_t kGrain = 8;
  /// Items per block where each takes hardly any time. Between 1024 and 16'384 no difference can be
  /// seen (decision 0073).
  static constexpr std::size_t kBlock = 4096;
  /// The number of triangles of a part, or of two, that is worth a whole team.
  static constexpr double kHeavy = 1 << 16;

  PairTasks(const ScenePartList& list, std::span<const geometry::IndexPair> pairs,
            const UniquePairs& unique_pairs, const parallel::Context& context)
      : list_(list), pairs_(pairs), unique_pairs_(unique_pairs), context_(context) {}

  [[nodiscard]] const parallel::Context& context() const { return context_; }
  [[nodiscard]] std::size_t size() const { return unique_pairs_.first.size(); }
  [[nodiscard]] const ScenePart& a(std::size_t i) const { return list_.parts[pair(i).first]; }
  [[nodiscard]] const ScenePart& b(std::size_t i) const { return list_.parts[pair(i).second]; }
  [[nodiscard]] std::size_t triangles(std::size_t i) const {
    return a(i).placed.part->triangles.size() + b(i).placed.part->triangles.size();
  }

  /// Returns which unique parts some of the unique pairs are about.
  [[nodiscard]] std::vector<bool> parts_of(std::span<const std::size_t> some) const {
    std::vector<bool> parts(list_.unique.size(), false);
    for (const std::size_t i : some) parts[a(i).unique] = parts[b(i).unique] = true;
    return parts;
  }

  /// Returns the unique pairs that pass a test, ascending. Errors here and below: cancelled.
  template <class Test>
  [[nodiscard]] Result<std::vector<std::size_t>> filter(std::string_view name, Test&& test) const {
    return parallel::collect<std::size_t>(context_, {.name = name, .n = size(), .grain = kBlock},
                                          [&](std::size_t i, std::vector<std::size_t>& out) {
                                            if (test(i)) out.push_back(i);
                                          });
  }

  /// Calls work(i, a, b) for some of the unique pairs, those with most triangles first; one that is
  /// very heavy has the team to itself.
  template <class Work>
  [[nodiscard]] Status for_each_of(std::span<const std::size_t> some, std::string_view name,
                                   std::size_t grain, Work&& work) const {
    return parallel::for_each_by_weight(
        context_, {.name = name, .n = some.size(), .grain = grain}, kHeavy,
        [&](std::size_t k) { return triangles(some[k]); },
        [&](std::size_t k) { work(some[k], a(some[k]), b(some[k])); });
  }

 private:
  [[nodiscard]] const geometry::IndexPair& pair(std::size_t i) const {
    return pairs_[unique_pairs_.first[i]];
  }

  const ScenePartList& list_;
  std::span<const geometry::IndexPair> pairs_;
  const UniquePairs& unique_pairs_;
  const parallel::Context& context_;
};

}  // namespace strake::clash
