// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "strake/clash/clash.hpp"

namespace strake::clash {

/// Two objects, a < b in the durable order.
struct ObjectPair {
  model::ObjectId a{}, b{};
  friend bool operator==(const ObjectPair&, const ObjectPair&) = default;
};

/// The bare question: which pairs of objects, one of set A and one of set B, have a point in
/// common, be it a touch, a crossing or one inside the other. Exact on the grid; primitives as
/// tessellated. Neither class nor depth: what a preview or a spatial join asks, in a third of the
/// time of detect(). Ascending; the same for any team.
///
/// Of the options only the broad phase and most_pairs count. Pairs of parts that lie too far from
/// each other for exact arithmetic (fits_pair()) have no point in common. Errors: as detect().
[[nodiscard]] Result<std::vector<ObjectPair>> overlapping_pairs(const model::Scene& scene,
                                                                const Sets& sets,
                                                                const Options& options,
                                                                const parallel::Context& context);

}  // namespace strake::clash
