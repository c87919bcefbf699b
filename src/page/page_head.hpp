// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
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

/// Returns the policy (Content-Security-Policy) that the head of a page states; empty where there
/// is none.
[[nodiscard]] std::string_view policy_in(std::string_view head);

/// Returns the head of a page whose policy lets it ask the server that it comes from. A page that
/// is a file asks nobody.
[[nodiscard]] std::string with_served_policy(std::string_view head);

}  // namespace strake::page
