// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "page/blocks/block.hpp"
#include "page/results/page_facts.hpp"
#include "page/results/page_objects.hpp"
#include "strake/report/clash.hpp"

namespace strake::page {

/// What the columns of results are made of; all of it must outlast the writing of the blocks.
struct ResultSource {
  const report::ClashContents& contents;
  const PageRows& rows;
  const PageNames& names;
  const PageObjects& objects;
  /// Who is to see to a result; null: nobody knows.
  std::function<std::string_view(const PageRow&)> assignee = {};
};

/// Returns the blocks strake-results, strake-regions where results have several, and strake-groups,
/// as far as there are rows of them.
[[nodiscard]] std::vector<Block> result_blocks(const ResultSource& source);

}  // namespace strake::page
