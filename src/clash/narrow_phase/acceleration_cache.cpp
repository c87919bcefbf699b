// SPDX-License-Identifier: Apache-2.0
#include "clash/narrow_phase/acceleration_cache.hpp"

#include <cstddef>
#include <cstdint>

#include "clash/pairs/pair_tasks.hpp"

namespace strake::clash {
namespace {

const geometry::TriangleBvh kNoTree;

}  // namespace

template <class T, class Make>
Status AccelerationCache::add(parallel::Precomputed<T>& kind, const std::vector<bool>& wanted,
                              std::string_view name, const parallel::Context& context,
                              Make&& make) {
  // This cannot be done earlier: the list was empty when this was made.
  if (kind.size() == 0) kind = parallel::Precomputed<T>(list_.unique.size());
  return kind.fill_by_weight(
      context, {.name = name}, PairTasks::kHeavy, parallel::keys_of(wanted),
      [&](std::size_t u) { return list_.unique[u]->triangles.size(); },
      [&](std::size_t u) { return make(*list_.unique[u]); });
}

Status AccelerationCache::ensure_frames(const std::vector<bool>& wanted,
                                        const parallel::Context& context) {
  return add(frames_, wanted, "part frames", context, [&](const geometry::Part& part) {
    return geometry::make_oriented_box(part, context);
  });
}

Status AccelerationCache::ensure_trees(const std::vector<bool>& wanted,
                                       const parallel::Context& context) {
  return add(trees_, wanted, "part trees", context,
             [&](const geometry::Part& part) { return geometry::TriangleBvh(part, context); });
}

Status AccelerationCache::ensure_planes(const std::vector<bool>& wanted,
                                        const parallel::Context& context) {
  return add(planes_, wanted, "support planes", context,
             [&](const geometry::Part& part) { return geometry::make_face_kdop(part, context); });
}

PairOperand AccelerationCache::bare(const ScenePart& part) const {
  return {{part.placed, &kNoTree}, nullptr, nullptr, &model_.bodies[part.body].placement};
}

PairOperand AccelerationCache::framed(const ScenePart& part) const {
  PairOperand aided = bare(part);
  aided.frame = frames_.find(part.unique);
  return aided;
}

PairOperand AccelerationCache::treed(const ScenePart& part) const {
  PairOperand aided = framed(part);
  if (const geometry::TriangleBvh* tree = trees_.find(part.unique)) aided.treed.tree = tree;
  return aided;
}

PairOperand AccelerationCache::planed(const ScenePart& part) const {
  PairOperand aided = treed(part);
  aided.planes = planes_.find(part.unique);
  return aided;
}

}  // namespace strake::clash
