// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/clash/clash.hpp"

namespace strake::clash {

/// A result as grouping sees it.
struct GroupingItem {
  const Pair* pair = nullptr;
  std::uint32_t test = 0, number = 0;  ///< as in ResultRef
};

/// The numbers of groups, one per item; `about` is the object that a group is about.
struct Partition {
  std::vector<std::uint32_t> group;
  std::vector<model::ObjectId> about;  ///< filled by by_element() only; of an assembly the first
  std::uint32_t count = 0;
};

/// Groups items by a greedy cover by objects, most items first. `stands_for` has for each object
/// the one that it counts as: itself, or the first of its assembly.
[[nodiscard]] Partition by_element(std::span<const GroupingItem> items,
                                   std::span<const model::ObjectId> stands_for);

/// Groups items by single linkage of their points.
[[nodiscard]] Partition by_proximity(std::span<const GroupingItem> items, double distance_mm);

}  // namespace strake::clash
