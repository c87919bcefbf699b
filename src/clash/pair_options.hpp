// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "clash/cases.hpp"
#include "clash/narrow_part.hpp"
#include "clash/pair_rules.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::clash {

/// What each pair of parts is judged by: the tolerances that the rules give it, and the precision
/// that the source's numbers have for its two bodies, whatever else there is in the files.
class PairOptions {
 public:
  /// `rules`, `options` and `model` must outlive this.
  PairOptions(const PairRules& rules, const Options& options, const model::Model& model);

  [[nodiscard]] NarrowOptions of(const PartRef& a, const PartRef& b) const;
  /// The same, to compare pairs by.
  [[nodiscard]] CaseSettings settings(const PartRef& a, const PartRef& b) const;

  /// The largest contact distance of a part, grid units.
  [[nodiscard]] Result<double> widest_band(std::span<const PartRef> parts,
                                           const parallel::Context& context) const;
  /// The smallest touch gap of any pair, grid units.
  [[nodiscard]] double least_touch_gap() const;

 private:
  [[nodiscard]] double band(const PartRef& part) const;
  [[nodiscard]] static double snap(const PartRef& a, const PartRef& b);

  const PairRules& rules_;
  const Options& options_;
  const model::Model& model_;
  std::vector<NarrowOptions> narrow_;  ///< by number of tolerances
};

}  // namespace strake::clash
