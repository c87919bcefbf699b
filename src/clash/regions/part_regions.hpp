// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/narrow_phase/narrow_phase.hpp"
#include "clash/pairs/pair_result.hpp"
#include "clash/pairs/pair_tasks.hpp"
#include "clash/rules/rule_matcher.hpp"

/// The separate regions in which two parts meet or are too near each other.
namespace strake::clash {

/// How far the regions of a pair of parts are told apart, each more than the one before.
enum class RegionDetail : std::uint8_t {
  whole,       ///< not at all: not asked for, or there can be only one
  if_several,  ///< where there are several
  each,        ///< even if there is only one: it is listed beside those of other parts
  all,         ///< those within the clearance too: a rule may allow what is worse
};

/// Returns for each unique pair the detail that lists of regions need, and rules that may allow one
/// region and not the other. Errors: cancelled.
[[nodiscard]] Result<std::vector<RegionDetail>> region_detail_of(const EvaluatedPairs& evaluated,
                                                                 const ObjectPairs& objects,
                                                                 const RuleMatcher& rules,
                                                                 const Options& options,
                                                                 const parallel::Context& context);

/// One of the regions where two parts meet or are too near each other.
struct PartRegion {
  PartPairResult answer;
  geometry::Box3d extent;  ///< encloses the region; grid units relative to a's origin
  bool is_whole = false;   ///< the result is that of the parts as a whole, to the bit
};

/// Returns the regions of two parts whose result as a whole is known and not NO_HIT: those within
/// the touch gap where they touch or meet, otherwise (or where `all` are asked for) those within
/// the clearance too. One of them has the result as a whole. Where there is only one, the list is
/// empty unless it is to be described. It is absent where too many triangles are near each other to
/// tell. Parts have trees unless they only touch and are small.
[[nodiscard]] std::optional<std::vector<PartRegion>> find_part_regions(
    const PairOperand& a, const PairOperand& b, const PartPairResult& whole,
    const PairTolerances& options, RegionDetail detail, NarrowWork& work);

/// Returns how near counts as meeting in a region, for two parts with this result, grid units.
[[nodiscard]] double region_reach(const PairOperand& a, const PairOperand& b,
                                  const PartPairResult& whole, const PairTolerances& options);

/// Returns, by unique pair, the regions of its parts, where lists or rules need them apart; none
/// where the result as a whole says all. Marks the candidates whose regions are too near each other
/// to be told apart. Errors: cancelled.
[[nodiscard]] Result<std::vector<std::vector<PartRegion>>> compute_part_regions(
    const StageInputs& stage, const EvaluatedPairs& evaluated, std::vector<Candidate>& candidates);

}  // namespace strake::clash
