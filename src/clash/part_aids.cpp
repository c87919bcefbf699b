// SPDX-License-Identifier: Apache-2.0
#include "clash/part_aids.hpp"

#include <cstddef>
#include <cstdint>

#include "clash/case_work.hpp"

namespace strake::clash {
namespace {

const geometry::PartTree kNoTree;

}  // namespace

template <class T, class Make>
Status PartAids::add(parallel::Precomputed<T>& kind, const std::vector<bool>& wanted,
                     std::string_view name, const parallel::Context& context, Make&& make) {
  // Not before: the list was empty when this was made.
  if (kind.size() == 0) kind = parallel::Precomputed<T>(list_.unique.size());
  return kind.fill_by_weight(
      context, {.name = name}, CaseWork::kHeavy, parallel::keys_of(wanted),
      [&](std::size_t u) { return list_.unique[u]->triangles.size(); },
      [&](std::size_t u) { return make(*list_.unique[u]); });
}

Status PartAids::want_frames(const std::vector<bool>& wanted, const parallel::Context& context) {
  return add(frames_, wanted, "part frames", context,
             [&](const geometry::Part& part) { return geometry::make_frame(part, context); });
}

Status PartAids::want_trees(const std::vector<bool>& wanted, const parallel::Context& context) {
  return add(trees_, wanted, "part trees", context,
             [&](const geometry::Part& part) { return geometry::PartTree(part, context); });
}

Status PartAids::want_planes(const std::vector<bool>& wanted, const parallel::Context& context) {
  return add(planes_, wanted, "support planes", context, [&](const geometry::Part& part) {
    return geometry::make_support_planes(part, context);
  });
}

NarrowPart PartAids::bare(const PartRef& part) const {
  return {{part.placed, &kNoTree}, nullptr, nullptr, &model_.bodies[part.body].placement};
}

NarrowPart PartAids::framed(const PartRef& part) const {
  NarrowPart aided = bare(part);
  aided.frame = frames_.find(part.unique);
  return aided;
}

NarrowPart PartAids::treed(const PartRef& part) const {
  NarrowPart aided = framed(part);
  if (const geometry::PartTree* tree = trees_.find(part.unique)) aided.treed.tree = tree;
  return aided;
}

NarrowPart PartAids::planed(const PartRef& part) const {
  NarrowPart aided = treed(part);
  aided.planes = planes_.find(part.unique);
  return aided;
}

}  // namespace strake::clash
