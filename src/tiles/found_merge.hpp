// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "clash/tiles/join_tiles.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "tiles/found_file.hpp"

namespace strake::tiles {

/// Appends what one test found in all tiles to a join, in the order of objects. Each tile has its
/// own in that order: they are merged, and of each only as much is unpacked at a time as there are
/// workers. Errors: input (kLost), cancelled, memory.
[[nodiscard]] Status merge_found(std::span<const FoundFile> found, std::size_t test,
                                 clash::TileJoin& join, const parallel::Context& context);

}  // namespace strake::tiles
