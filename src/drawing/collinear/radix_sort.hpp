// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// A sorting key and what it belongs to.
struct KeyedItem {
  std::uint64_t key = 0;
  std::uint32_t item = 0;
};

/// Sorts by key, equal keys in the order in which they come.
///
/// Radix sort from the lowest digit, 11 bits at a time, as far as the highest key reaches: a piece
/// of the items is counted and dealt by one worker. The same for any team.
[[nodiscard]] Status radix_sort(std::vector<KeyedItem>& items, const parallel::Context& context);

}  // namespace strake::drawing
