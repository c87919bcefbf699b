// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0114 says how results of few objects are found without a look at all.

#include <cstddef>
#include <vector>

#include "clash/incremental/object_map.hpp"
#include "strake/clash/incremental.hpp"

/// The results of few objects among very many.
namespace strake::clash {

/// Returns how many PartnerBlocks so many objects have.
[[nodiscard]] std::size_t count_blocks(std::size_t objects);

/// Returns of each block of objects of an earlier run, as the a of its results, whether any of
/// these may be of an object that changed.
[[nodiscard]] std::vector<bool> blocks_of_changes(const PartnerBlocks& partners,
                                                  const ObjectMap& map);

}  // namespace strake::clash
