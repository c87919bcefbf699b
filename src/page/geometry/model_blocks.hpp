// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "page/blocks/block.hpp"
#include "page/geometry/shown_objects.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::page {

/// The model as a page has it: blocks, which hold what they are made of, and what the head says of
/// them.
struct ModelBlocks {
  std::vector<Block> blocks;  ///< strake-shapes, strake-instances, strake-boxes as far as needed
  std::string scene;          ///< the member of the head, a JSON object
};

/// Makes the blocks of the objects that are shown. `numbers` has the number of each object in the
/// page. Errors: cancelled, out of memory.
[[nodiscard]] Result<ModelBlocks> model_blocks(
    const model::Scene& scene, const ShownObjects& shown,
    const std::shared_ptr<const std::vector<std::uint32_t>>& numbers,
    const parallel::Context& context);

}  // namespace strake::page
