// SPDX-License-Identifier: Apache-2.0
#include "clash/parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>

#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

constexpr std::size_t kGrain = 4096;

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

/// Puts all parts of two objects side by side in a list of pairs that is ascending by parts, which
/// are themselves by object: the second part's object goes before the first part.
void gather_by_objects(std::vector<geometry::IndexPair>& pairs, const PartList& list) {
  const auto object = [&](std::uint32_t part) { return list.parts[part].object; };
  for (std::size_t first = 0; first < pairs.size();) {
    std::size_t end = first + 1;
    bool one_part = true;
    for (; end < pairs.size() && object(pairs[end].first) == object(pairs[first].first); ++end)
      one_part = one_part && pairs[end].first == pairs[first].first;
    if (!one_part)
      std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first),
                pairs.begin() + static_cast<std::ptrdiff_t>(end),
                [&](const auto& x, const auto& y) {
                  return std::tuple{object(x.second), x.first, x.second} <
                         std::tuple{object(y.second), y.first, y.second};
                });
    first = end;
  }
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
  const auto items =
      parallel::transform(context, {.name = "boxes", .n = list.parts.size(), .grain = kGrain},
                          [&](std::size_t i) { return item_of(list.parts[i], sets, reach); });
  if (!items) return items.error();
  auto pairs = box_pairs(*items, options, context);
  if (!pairs) return pairs.error().code == ErrorCode::input ? too_many(options) : pairs.error();
  if (!sets.group.empty())
    std::erase_if(*pairs, [&](const geometry::IndexPair& p) {
      return sets.group[list.parts[p.first].object] == sets.group[list.parts[p.second].object];
    });
  gather_by_objects(*pairs, list);
  return pairs;
}

}  // namespace strake::clash
