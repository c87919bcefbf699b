// SPDX-License-Identifier: Apache-2.0
#include "clash/part_aids.hpp"

#include <cstddef>
#include <cstdint>

#include "clash/case_work.hpp"
#include "strake/parallel/heavy.hpp"

namespace strake::clash {
namespace {

const geometry::PartTree kNoTree;

}  // namespace

template <class T, class Make>
Status PartAids::add(Kind<T>& kind, const std::vector<bool>& wanted, std::string_view name,
                     const parallel::Context& context, Make&& make) {
  kind.all.resize(list_.unique.size());
  kind.made.resize(list_.unique.size(), false);
  std::vector<std::uint32_t> missing;
  for (std::uint32_t u = 0; u < wanted.size(); ++u)
    if (wanted[u] && !kind.made[u]) missing.push_back(u);
  const Status status = parallel::for_each_by_weight(
      context, {.name = name, .n = missing.size()}, CaseWork::kHeavy,
      [&](std::size_t i) { return list_.unique[missing[i]]->triangles.size(); },
      [&](std::size_t i) { kind.all[missing[i]] = make(*list_.unique[missing[i]]); });
  if (!status) return status;
  for (const std::uint32_t u : missing) kind.made[u] = true;
  return {};
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
  aided.frame = frames_.of(part);
  return aided;
}

NarrowPart PartAids::treed(const PartRef& part) const {
  NarrowPart aided = framed(part);
  if (const geometry::PartTree* tree = trees_.of(part)) aided.treed.tree = tree;
  return aided;
}

NarrowPart PartAids::planed(const PartRef& part) const {
  NarrowPart aided = treed(part);
  aided.planes = planes_.of(part);
  return aided;
}

}  // namespace strake::clash
