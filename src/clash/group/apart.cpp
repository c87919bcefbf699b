// SPDX-License-Identifier: Apache-2.0
#include "clash/group/partition.hpp"

namespace strake::clash {

Partition apart(std::span<const GroupingItem> items, const Partition& together,
                double distance_mm) {
  std::vector<std::vector<std::uint32_t>> members(together.count);
  for (std::uint32_t i = 0; i < items.size(); ++i) members[together.group[i]].push_back(i);
  Partition partition;
  partition.group.resize(items.size());
  for (std::uint32_t g = 0; g < together.count; ++g) {
    std::vector<GroupingItem> of_group;
    for (const std::uint32_t i : members[g]) of_group.push_back(items[i]);
    const Partition places = by_proximity(of_group, distance_mm);
    for (std::size_t k = 0; k < of_group.size(); ++k)
      partition.group[members[g][k]] = partition.count + places.group[k];
    partition.count += places.count;
    if (!together.about.empty()) partition.about.resize(partition.count, together.about[g]);
  }
  return partition;
}

}  // namespace strake::clash
