// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/narrow_phase/narrow_phase.hpp"
#include "clash/pairs/pair_result.hpp"
#include "clash/pairs/pair_tasks.hpp"
#include "clash/rules/rule_matcher.hpp"

/// The separate regions in which two parts meet or are too near each other.
namespace strake::clash {

/// How far the regions of a pair of parts are distinguished, each more than the one before.
enum class RegionDetail : std::uint8_t {
  whole,       ///< not at all: not requested, or there can be only one
  if_several,  ///< where there are several
  each,        ///< even if there is only one: it is listed beside those of other parts
  all,         ///< those within the clearance too: a rule may allow what is worse
};

/// Returns for each pair the detail that lists of regions need, and rules that may allow one region
/// and not the other. Errors: cancelled.
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
/// the touch gap where they touch or meet, otherwise (or where `all` are requested) those within
/// the clearance too. One of them has the result as a whole. Where there is only one, the list is
/// empty unless it is to be described. It is absent where too many triangles are near each other to
/// tell. Parts have trees unless they only touch and are small.
[[nodiscard]] std::optional<std::vector<PartRegion>> find_part_regions(
    const PairOperand& a, const PairOperand& b, const PartPairResult& whole,
    const PairTolerances& options, RegionDetail detail, NarrowWork& work);

/// Returns how near counts as meeting in a region, for two parts with this result, grid units.
[[nodiscard]] double region_reach(const PairOperand& a, const PairOperand& b,
                                  const PartPairResult& whole, const PairTolerances& options);

/// The regions of unique pairs, distinguished to one detail.
struct DetailedRegions {
  std::vector<std::vector<PartRegion>> of_unique;
  std::vector<std::uint8_t> too_near;  ///< whether they cannot be distinguished
};

/// The regions of the parts of all pairs. Equal pairs of parts share them only where their pairs of
/// objects need them in the same detail, so that none shows in the result of another.
class PartRegions {
 public:
  PartRegions() = default;
  PartRegions(std::vector<RegionDetail> detail, DetailedRegions several, DetailedRegions each)
      : detail_(std::move(detail)), several_(std::move(several)), each_(std::move(each)) {}

  /// Returns the regions of a pair; none where the result as a whole says all. `unique` is the
  /// number of its unique pair.
  [[nodiscard]] std::span<const PartRegion> of(std::size_t pair, std::uint32_t unique) const {
    if (!has_regions(pair)) return {};
    return level(pair).of_unique[unique];
  }
  /// Whether the regions of a pair are too near each other: it has one or several.
  [[nodiscard]] bool is_count_uncertain(std::size_t pair, std::uint32_t unique) const {
    return has_regions(pair) && level(pair).too_near[unique] != 0;
  }

 private:
  [[nodiscard]] bool has_regions(std::size_t pair) const {
    return pair < detail_.size() && detail_[pair] != RegionDetail::whole;
  }
  [[nodiscard]] const DetailedRegions& level(std::size_t pair) const {
    return detail_[pair] == RegionDetail::if_several ? several_ : each_;
  }

  std::vector<RegionDetail> detail_;  ///< by pair
  DetailedRegions several_, each_;
};

/// Finds the regions where lists or rules need them apart. Errors: cancelled.
[[nodiscard]] Result<PartRegions> compute_part_regions(const StageInputs& stage,
                                                       const EvaluatedPairs& evaluated,
                                                       std::vector<Candidate>& candidates);

}  // namespace strake::clash
