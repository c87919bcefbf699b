// SPDX-License-Identifier: Apache-2.0
#include "clash/object_pairs.hpp"

#include "clash/runs.hpp"

namespace strake::clash {

Result<ObjectPairs> ObjectPairs::find(std::span<const geometry::IndexPair> pairs,
                                      const PartList& list, const parallel::Context& context) {
  const auto object = [&](std::uint32_t part) { return list.parts[part].object; };
  auto begin = find_runs(
      pairs, "pairs of objects",
      [&](const auto& x, const auto& y) {
        return object(x.first) == object(y.first) && object(x.second) == object(y.second);
      },
      context);
  if (!begin) return begin.error();
  return ObjectPairs(std::move(*begin));
}

}  // namespace strake::clash
