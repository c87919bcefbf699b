// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// A sorting key and the item that it belongs to.
struct KeyedItem {
  std::uint64_t key = 0;
  std::uint32_t item = 0;
};

/// Sorts by key, stably.
///
/// Radix sort from the lowest digit, 11 bits at a time, up to the highest key; each worker counts
/// and distributes a block of the items. The result does not depend on the team.
[[nodiscard]] Status radix_sort(std::vector<KeyedItem>& items, const parallel::Context& context);

}  // namespace strake::drawing
