// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/pairs/pair_result.hpp"
#include "clash/rules/rule_matcher.hpp"

namespace strake::clash {

/// The result for one pair of parts, or for one region of it, by the number of the pair;
/// not null.
struct PartResult {
  std::size_t pair_index = 0;
  const PartPairResult* answer = nullptr;
  const geometry::Box3d* extent = nullptr;  ///< the region's box, if known; relative to a's origin
  bool region_count_uncertain = false;      ///< too near: there is one region or several
  /// Whether the result of the two objects depends on it; regions of two parts other than their
  /// worst decide only where a rule may allow that one.
  bool decides = true;
  /// What the two objects have in common, where a rule or the test limits it.
  const CommonVolume* common = nullptr;
};

/// What was found about parts, and what is needed to aggregate it by objects.
struct PartResults {
  const std::vector<PartResult>& found;  ///< by pair
  const std::vector<geometry::IndexPair>& pairs;
  const ScenePartList& list;
  const RuleMatcher& rules;

  [[nodiscard]] const ScenePart& a(std::size_t i) const {
    return list.parts[pairs[found[i].pair_index].first];
  }
  [[nodiscard]] const ScenePart& b(std::size_t i) const {
    return list.parts[pairs[found[i].pair_index].second];
  }
  [[nodiscard]] bool same_objects(std::size_t i, std::size_t j) const {
    return a(i).object == a(j).object && b(i).object == b(j).object;
  }
  /// Whether the next result is about the same two objects.
  [[nodiscard]] bool has_more(std::size_t i) const {
    return i + 1 < found.size() && same_objects(i, i + 1);
  }
  /// Returns the box of the region, if known.
  [[nodiscard]] std::optional<geometry::Box3d> extent_mm(std::size_t i) const;
  /// Returns the result as one about the two objects.
  [[nodiscard]] Pair pair(std::size_t i) const;
};

/// Whether x, of two results about one pair of objects, decides.
[[nodiscard]] bool is_more_severe(const Pair& x, const Pair& y);

/// Returns the pairs of objects that are not NO_HIT: the results of their parts are aggregated by
/// whether a rule allows them, class, level and d. Where brackets leave open which of them is the
/// worst, the weightiest relation counts; then d, witness and part numbers: a function of the set
/// of results. Whether regions were distinguished shows in it only through rules.
/// Pair::first_region is the number of the pair's first result. Errors: cancelled.
[[nodiscard]] Result<std::vector<Pair>> aggregate_by_object(const PartResults& results,
                                                            const parallel::Context& context);

}  // namespace strake::clash
