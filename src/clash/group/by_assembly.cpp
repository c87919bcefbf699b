// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <utility>

#include "clash/group/partition.hpp"

namespace strake::clash {
namespace {

/// What an object is a part of: its assembly, or its file where it has none.
using AssemblyOrFile = std::pair<std::uint32_t, model::GroupId>;

AssemblyOrFile whole_of(const model::Model& model, const model::ObjectAssemblies& assemblies,
                        model::ObjectId id) {
  return {model.object(id).file, assemblies.of(id)};
}

}  // namespace

Partition by_assembly(std::span<const GroupingItem> items, const model::Model& model,
                      const model::ObjectAssemblies& assemblies) {
  std::map<std::pair<AssemblyOrFile, AssemblyOrFile>, std::uint32_t> numbers;
  Partition partition;
  for (const GroupingItem& item : items) {
    const std::pair<AssemblyOrFile, AssemblyOrFile> pair = std::minmax(
        whole_of(model, assemblies, item.pair->a), whole_of(model, assemblies, item.pair->b));
    const auto [at, is_new] = numbers.try_emplace(pair, partition.count);
    if (is_new) ++partition.count;
    partition.group.push_back(at->second);
  }
  return partition;
}

}  // namespace strake::clash
