// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/clash/clash.hpp"

namespace strake::clash {

/// What grouping asks of a result.
struct GroupingItem {
  const Pair* pair = nullptr;
  std::uint32_t test = 0, number = 0;  ///< as in ResultRef
};

/// Numbers of groups, one per item; `about` is the object that a group is about.
struct Partition {
  std::vector<std::uint32_t> group;
  std::vector<model::ObjectId> about;  ///< by element only
  std::uint32_t count = 0;
};

/// Greedy cover by objects, most items first.
[[nodiscard]] Partition by_element(std::span<const GroupingItem> items);

/// Single linkage of the items' points.
[[nodiscard]] Partition by_proximity(std::span<const GroupingItem> items, double distance_mm);

}  // namespace strake::clash
