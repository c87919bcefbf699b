// SPDX-License-Identifier: Apache-2.0
#include "clash/object_pairs.hpp"

#include "strake/parallel/collect.hpp"

namespace strake::clash {

Result<ObjectPairs> ObjectPairs::find(std::span<const geometry::IndexPair> pairs,
                                      const PartList& list, const parallel::Context& context) {
  constexpr std::size_t kGrain = 16384;
  const auto object = [&](std::uint32_t part) { return list.parts[part].object; };
  auto begin = parallel::collect<std::size_t>(
      context, {.name = "pairs of objects", .n = pairs.size(), .grain = kGrain},
      [&](std::size_t i, std::vector<std::size_t>& out) {
        if (i == 0 || object(pairs[i - 1].first) != object(pairs[i].first) ||
            object(pairs[i - 1].second) != object(pairs[i].second))
          out.push_back(i);
      });
  if (!begin) return begin.error();
  begin->push_back(pairs.size());
  return ObjectPairs(std::move(*begin));
}

}  // namespace strake::clash
