// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "clash/broad_phase/broad_phase.hpp"
#include "clash/incremental/object_map.hpp"
#include "strake/clash/clash.hpp"

namespace strake::clash {

/// What one pass over all bodies finds: which objects are near those that changed, and what a
/// report says of all bodies together.
struct Neighbours {
  std::vector<Change> change;             ///< by object
  std::vector<std::uint32_t> tested;      ///< those that changed or are near, ascending
  std::uint64_t parts = 0;                ///< parts that are tested
  float widest_precision_um = 0;          ///< of their bodies
  std::vector<std::uint8_t> unknown_sag;  ///< by file: whether a part of it has an unknown sag
};

/// Finds the neighbours of changed objects. No tree is built over those that did not change.
/// Errors: cancelled.
[[nodiscard]] Result<Neighbours> find_neighbours(const model::Scene& scene, const Sets& sets,
                                                 const Options& options, const SearchReach& reach,
                                                 const ObjectMap& map,
                                                 const parallel::Context& context);

}  // namespace strake::clash
