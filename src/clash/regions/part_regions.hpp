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

namespace strake::clash {

/// How the places of a pair of parts are told, each more than the one before.
enum class RegionDetail : std::uint8_t {
  whole,       ///< not at all: nobody asks, or there can be only one
  if_several,  ///< where there are several
  each,        ///< even if there is only one: it stands beside those of other parts
  all,         ///< and those within the clearance too: a rule may allow what is worse
};

/// For each case: what lists of regions ask about it, and rules that may allow one place and not
/// the other. Errors: cancelled.
[[nodiscard]] Result<std::vector<RegionDetail>> region_detail_of(const EvaluatedPairs& evaluated,
                                                                 const ObjectPairs& objects,
                                                                 const RuleMatcher& rules,
                                                                 const Options& options,
                                                                 const parallel::Context& context);

/// One of the places where two parts meet or are too near each other.
struct PartRegion {
  PartPairResult answer;
  geometry::Box3d extent;  ///< holds the place; grid units relative to a's origin
  bool is_whole = false;   ///< the answer is that of the parts as a whole, to the bit
};

/// The places of two parts whose answer as a whole is known and not NO_HIT: those within the touch
/// gap where they touch or meet, those within the clearance otherwise, or too where all are asked
/// for. One of them has the answer as a whole. Where there is only one, an empty list unless it is
/// to be described. Nothing where there are too many triangles near each other to tell. Parts have
/// trees unless they only touch and are small.
[[nodiscard]] std::optional<std::vector<PartRegion>> find_part_regions(
    const PairOperand& a, const PairOperand& b, const PartPairResult& whole,
    const PairTolerances& options, RegionDetail detail, NarrowWork& work);

/// How near counts as meeting in a place, for two parts with this answer, grid units.
[[nodiscard]] double region_reach(const PairOperand& a, const PairOperand& b,
                                  const PartPairResult& whole, const PairTolerances& options);

/// By case: the places of its parts, where regions or rules ask to tell them apart; none where the
/// answer as a whole is all there is to tell. Marks the candidates whose places are too near each
/// other to be told. Errors: cancelled.
[[nodiscard]] Result<std::vector<std::vector<PartRegion>>> compute_part_regions(
    const StageInputs& stage, const EvaluatedPairs& evaluated, std::vector<Candidate>& candidates);

}  // namespace strake::clash
