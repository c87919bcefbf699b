// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/object_assemblies.hpp"
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
  std::vector<model::ObjectId> about;  ///< of groups by element only
  std::uint32_t count = 0;
};

/// Groups items by a greedy cover by objects, most items first.
[[nodiscard]] Partition by_element(std::span<const GroupingItem> items);

/// Groups items by single linkage of their points.
[[nodiscard]] Partition by_proximity(std::span<const GroupingItem> items, double distance_mm);

/// Groups items by the assemblies of the two objects, or their files where they have none.
[[nodiscard]] Partition by_assembly(std::span<const GroupingItem> items, const model::Model& model,
                                    const model::ObjectAssemblies& assemblies);

/// Splits groups into those whose points are linked by single linkage.
[[nodiscard]] Partition apart(std::span<const GroupingItem> items, const Partition& together,
                              double distance_mm);

}  // namespace strake::clash
