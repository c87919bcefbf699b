// SPDX-License-Identifier: Apache-2.0
#include "clash/parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>

namespace strake::clash {
namespace {

geometry::BoxItem item_of(const PartRef& ref, const Sets& sets, double reach) {
  geometry::BoxItem item;
  item.box = inflated_box(ref, reach);
  item.owner = ref.object;
  item.sets = static_cast<std::uint8_t>((sets.in_a[ref.object] ? geometry::kSetA : 0U) |
                                        (sets.in_b[ref.object] ? geometry::kSetB : 0U));
  return item;
}

Result<std::vector<geometry::IndexPair>> box_pairs(const std::vector<geometry::BoxItem>& items,
                                                   const Options& options,
                                                   const parallel::Context& context) {
  if (options.broad_phase == BroadPhase::all_pairs)
    return geometry::meeting_pairs_all(items, context, options.most_pairs);
  const auto tree = geometry::BoxTree::build(items, context);
  if (!tree) return tree.error();
  return geometry::meeting_pairs(*tree, context, options.most_pairs);
}

Error too_many(const Options& options) {
  return {ErrorCode::input,
          "more than " + std::to_string(options.most_pairs) +
              " pairs of parts are within reach of each other",
          "clash",
          "give a smaller clearance, or raise the limit with --most-pairs; or the model holds many "
          "objects at one place"};
}

}  // namespace

geometry::Box3l inflated_box(const PartRef& ref, double reach) {
  const auto inflation = static_cast<std::int64_t>(std::ceil(reach / 2 + ref.placed.part->sag));
  const geometry::Vec3l more{inflation, inflation, inflation};
  const geometry::Box3i& box = ref.placed.part->box;
  return {box.lo.as<std::int64_t>() + ref.placed.origin - more,
          box.hi.as<std::int64_t>() + ref.placed.origin + more};
}

PartList list_parts(const model::Scene& scene, const Sets& sets) {
  PartList list;
  std::vector<std::uint32_t> first(scene.shapes.size() + 1, 0);
  for (std::size_t s = 0; s < scene.shapes.size(); ++s) {
    for (const geometry::Part& part : scene.shapes[s].parts) list.unique.push_back(&part);
    first[s + 1] = static_cast<std::uint32_t>(list.unique.size());
  }
  for (std::size_t o = 0; o + 1 < scene.first_body.size(); ++o) {
    if (!sets.in_a[o] && !sets.in_b[o]) continue;
    std::uint32_t number = 0;
    for (std::size_t b = scene.first_body[o]; b < scene.first_body[o + 1]; ++b) {
      const model::GridBody& body = scene.bodies[b];
      const std::vector<geometry::Part>& parts = scene.shapes[body.grid_shape].parts;
      for (std::size_t p = 0; p < parts.size(); ++p, ++number) {
        if (parts[p].kind == geometry::PartKind::wire || parts[p].triangles.empty()) continue;
        list.parts.push_back({{&parts[p], body.origin},
                              static_cast<std::uint32_t>(o),
                              number,
                              first[body.grid_shape] + static_cast<std::uint32_t>(p),
                              body.body});
      }
    }
  }
  return list;
}

Result<std::vector<geometry::IndexPair>> near_pairs(const PartList& list, const Sets& sets,
                                                    double reach, const Options& options,
                                                    const parallel::Context& context) {
  std::vector<geometry::BoxItem> items;
  items.reserve(list.parts.size());
  for (const PartRef& ref : list.parts) items.push_back(item_of(ref, sets, reach));
  auto pairs = box_pairs(items, options, context);
  if (!pairs) return pairs.error().code == ErrorCode::input ? too_many(options) : pairs.error();
  if (!sets.group.empty())
    std::erase_if(*pairs, [&](const geometry::IndexPair& p) {
      return sets.group[list.parts[p.first].object] == sets.group[list.parts[p.second].object];
    });
  // The second part's object goes before the first part: all parts of two objects side by side.
  const auto key = [&](const geometry::IndexPair& p) {
    return std::tuple{list.parts[p.first].object, list.parts[p.second].object, p.first, p.second};
  };
  std::sort(pairs->begin(), pairs->end(),
            [&](const auto& x, const auto& y) { return key(x) < key(y); });
  return pairs;
}

}  // namespace strake::clash
