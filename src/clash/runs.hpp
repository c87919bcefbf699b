// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "strake/parallel/collect.hpp"

namespace strake::clash {

/// Where the runs of a list begin, ascending, and at last the end of the list. An item goes on with
/// the run of the one before it where `same(one before, item)`. Errors: cancelled.
template <class List, class Same>
[[nodiscard]] Result<std::vector<std::size_t>> find_runs(const List& list, std::string_view name,
                                                         const Same& same,
                                                         const parallel::Context& context) {
  constexpr std::size_t kGrain = 16384;
  auto begin =
      parallel::collect<std::size_t>(context, {.name = name, .n = list.size(), .grain = kGrain},
                                     [&](std::size_t i, std::vector<std::size_t>& out) {
                                       if (i == 0 || !same(list[i - 1], list[i])) out.push_back(i);
                                     });
  if (begin) begin->push_back(list.size());
  return begin;
}

}  // namespace strake::clash
