// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clash/pairs/pair_result.hpp"
#include "clash/pairs/pair_tasks.hpp"
#include "clash/rules/rule_matcher.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

/// The tolerances of one pair of parts, and the table of those that a run has.
namespace strake::clash {

/// Returns the thresholds of a pair, with t_o' of docs/clash.md, "Classes".
[[nodiscard]] Thresholds thresholds(const geometry::Part& a, const geometry::Part& b,
                                    const PairTolerances& options);

/// Returns how far the corners of two parts may move, in grid units, for parts that such moves
/// separate to be touching: the contact distance, of two sheets no more than may overlap, or it
/// would decide their class.
[[nodiscard]] double apart_within(const geometry::Part& a, const geometry::Part& b,
                                  const PairTolerances& options);

/// Returns the flags of a pair that come from its parts.
[[nodiscard]] std::uint16_t part_flags(const geometry::Part& a, const geometry::Part& b);

/// Returns how far apart is too far for any class, grid units.
[[nodiscard]] double reach_of(const PairTolerances& options);

/// Returns reach_of() for triangles: true surfaces may stand out of them by the sag of both.
[[nodiscard]] double reach_with_sag(const geometry::Part& a, const geometry::Part& b,
                                    const PairTolerances& options);

/// The tolerances of each pair of parts: those that the rules give it, and the precision that the
/// source's numbers have for its two bodies, whatever else there is in the files.
class PairToleranceTable {
 public:
  /// `rules`, `options` and `model` must outlive this.
  PairToleranceTable(const RuleMatcher& rules, const Options& options, const model::Model& model);

  [[nodiscard]] PairTolerances of(const ScenePart& a, const ScenePart& b) const;
  /// Returns a key by which the tolerances of pairs can be compared.
  [[nodiscard]] PairToleranceKey settings(const ScenePart& a, const ScenePart& b) const;

  /// Returns the largest contact distance of a part, grid units.
  [[nodiscard]] Result<double> widest_band(std::span<const ScenePart> parts,
                                           const parallel::Context& context) const;
  /// Returns the smallest touch gap of any pair, grid units.
  [[nodiscard]] double min_touch_gap() const;

 private:
  [[nodiscard]] double band(const ScenePart& part) const;
  [[nodiscard]] static double snap(const ScenePart& a, const ScenePart& b);

  const RuleMatcher& rules_;
  const Options& options_;
  const model::Model& model_;
  std::vector<PairTolerances> narrow_;  ///< by number of tolerances
};

}  // namespace strake::clash
