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

/// Returns the pairs of objects, one of set A and one of set B, that have a point in common, be it
/// a touch, a crossing or one inside the other: exact on the grid, primitives as tessellated, in
/// ascending order, the same for any team. It finds neither class nor depth: it is for previews and
/// spatial joins, and takes a third of the time of detect().
///
/// Of the options only the broad phase and max_pairs count. Pairs of parts that lie too far from
/// each other for exact arithmetic (fits_pair()) have no point in common. Errors: as detect().
[[nodiscard]] Result<std::vector<ObjectPair>> overlapping_pairs(const model::Scene& scene,
                                                                const Sets& sets,
                                                                const Options& options,
                                                                const parallel::Context& context);

}  // namespace strake::clash
