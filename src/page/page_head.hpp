// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "page/blocks/block.hpp"
#include "page/page.hpp"
#include "page/results/page_facts.hpp"

namespace strake::page {

/// What the head of a page says of the rest.
struct HeadFacts {
  std::size_t results = 0, groups = 0, objects = 0;
  const PageNames& names;
  const std::vector<Block>& blocks;
  const std::string& scene;  ///< the member, or empty
};

/// Returns the JSON of the block strake-head. Errors: cancelled, out of memory.
[[nodiscard]] Result<std::string> page_head(const PageContents& contents, const HeadFacts& facts,
                                            const parallel::Context& context);

}  // namespace strake::page
