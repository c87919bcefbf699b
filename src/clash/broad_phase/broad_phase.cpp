// SPDX-License-Identifier: Apache-2.0
#include "clash/broad_phase/broad_phase.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "clash/broad_phase/oriented_boxes.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"
#include "strake/parallel/count_fill.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

// Only shares the work out: between 1024 and 16'384 no difference can be seen (decision 0073).
constexpr std::size_t kItemsPerBlock = 4096;

geometry::BoxItem item_of(const ScenePart& ref, const Sets& sets, const SearchReach& reach) {
  geometry::BoxItem item;
  item.box = inflated_box(ref, reach.of(ref));
  item.owner = ref.object;
  item.sets = static_cast<std::uint8_t>((sets.in_a[ref.object] ? geometry::kSetA : 0U) |
                                        (sets.in_b[ref.object] ? geometry::kSetB : 0U));
  return item;
}

/// The number of pairs of boxes per part above which it is checked whether boxes along the
/// coordinate axes are why there are so many. 10,000 rods along 1,1,1 have 5,000 a part; with boxes
/// along the rods they take 0.014 CPU s instead of being refused (decision 0041).
constexpr std::uint64_t kManyPairs = 32;

/// Finds the pairs of boxes by one of the two broad phases.
class BoxPairs {
 public:
  BoxPairs(const std::vector<geometry::BoxItem>& items, const Options& options,
           const parallel::Context& context)
      : items_(items), options_(options), context_(context) {}

  Result<std::vector<geometry::IndexPair>> find(std::uint64_t limit) {
    if (all()) return geometry::overlapping_box_pairs_brute_force(items_, context_, limit);
    if (tree_.nodes().empty()) {
      auto tree = geometry::SceneBvh::build(items_, context_);
      if (!tree) return tree.error();
      tree_ = std::move(*tree);
    }
    return geometry::overlapping_box_pairs(tree_, context_, limit);
  }
  [[nodiscard]] Result<std::vector<geometry::IndexPair>> find(
      const geometry::BoxesInFrames& framed) const {
    return all() ? geometry::overlapping_box_pairs_brute_force(items_, framed, context_,
                                                               options_.engine.max_pairs)
                 : geometry::overlapping_box_pairs(items_, framed, context_,
                                                   options_.engine.max_pairs);
  }

 private:
  [[nodiscard]] bool all() const { return options_.engine.broad_phase == BroadPhase::all_pairs; }

  const std::vector<geometry::BoxItem>& items_;
  const Options& options_;
  const parallel::Context& context_;
  geometry::SceneBvh tree_;
};

/// Returns the pairs of boxes. Whether there are many is the same for any team and either broad
/// phase, so the response to it is too.
Result<CandidatePairs> box_pairs(const std::vector<geometry::BoxItem>& items,
                                 const ScenePartList& list, const SearchReach& reach,
                                 const Options& options, const parallel::Context& context) {
  BoxPairs by_boxes(items, options, context);
  auto pairs = by_boxes.find(max_unframed_pairs(items.size(), options));
  const bool many = !pairs && pairs.error().code == ErrorCode::input;
  if (many) {
    const auto framed = make_oriented_boxes(list, reach, context);
    if (!framed) return framed.error();
    pairs = framed->frames.size() > 1 ? by_boxes.find(*framed)
                                      : by_boxes.find(options.engine.max_pairs);
  }
  if (!pairs) return pairs.error();
  CandidatePairs found{std::move(*pairs), 0, many};
  found.boxes = found.pairs.size();
  return found;
}

/// Returns the pairs that lie in different groups.
Result<std::vector<geometry::IndexPair>> across_groups(
    const std::vector<geometry::IndexPair>& pairs, const ScenePartList& list, const Sets& sets,
    const parallel::Context& context) {
  const auto group = [&](std::uint32_t part) { return sets.group[list.parts[part].object]; };
  return parallel::collect<geometry::IndexPair>(
      context, {.name = "pairs across groups", .n = pairs.size(), .grain = kItemsPerBlock},
      [&](std::size_t i, std::vector<geometry::IndexPair>& out) {
        if (group(pairs[i].first) != group(pairs[i].second)) out.push_back(pairs[i]);
      });
}

/// Puts all parts of two objects side by side in a list of pairs that is ascending by parts, which
/// are themselves by object: the second part's object goes before the first part.
Status gather_by_objects(std::vector<geometry::IndexPair>& pairs, const ScenePartList& list,
                         const parallel::Context& context) {
  const auto object = [&](std::uint32_t part) { return list.parts[part].object; };
  const auto gather = [&](std::span<geometry::IndexPair> of_object) {
    // Sort by the first part.
    if (of_object.front().first != of_object.back().first)
      std::sort(of_object.begin(), of_object.end(), [&](const auto& x, const auto& y) {
        return std::tuple{object(x.second), x.first, x.second} <
               std::tuple{object(y.second), y.first, y.second};
      });
  };
  const auto runs = find_runs(
      pairs, "pairs by first object",
      [&](const auto& x, const auto& y) { return object(x.first) == object(y.first); }, context);
  if (!runs) return runs.error();
  const std::vector<std::size_t>& at = *runs;
  return parallel::for_each(
      context, {.name = "gather by objects", .n = at.size() - 1, .grain = kItemsPerBlock},
      [&](std::size_t k) { gather(std::span(pairs).subspan(at[k], at[k + 1] - at[k])); });
}

Error too_many(const Options& options) {
  return {ErrorCode::input,
          "more than " + std::to_string(options.engine.max_pairs) +
              " pairs of parts are within reach of each other",
          "clash",
          "give a smaller clearance, or raise the limit with --max-pairs; or the model holds many "
          "objects at one place"};
}

/// Takes out the pairs within a group, and brings the others into the order of their objects.
Status put_in_order(CandidatePairs& found, const ScenePartList& list, const Sets& sets,
                    const parallel::Context& context) {
  if (!sets.group.empty()) {
    auto across = across_groups(found.pairs, list, sets, context);
    if (!across) return across.error();
    found.pairs = std::move(*across);
  }
  return gather_by_objects(found.pairs, list, context);
}

/// Whether one of two objects is in A and the other in B.
bool are_compared(const Sets& sets, std::uint32_t x, std::uint32_t y) {
  return (sets.in_a[x] && sets.in_b[y]) || (sets.in_a[y] && sets.in_b[x]);
}

}  // namespace

std::uint64_t max_unframed_pairs(std::uint64_t parts, const Options& options) {
  return std::min(options.engine.max_pairs, kManyPairs * parts);
}

geometry::Box3l inflated_box(const ScenePart& ref, double reach) {
  const double beyond = ref.placed.part->sag + static_cast<double>(ref.step);
  const auto inflation = static_cast<std::int64_t>(std::ceil(reach / 2 + beyond));
  return ref.placed.part->box.as<std::int64_t>().moved(ref.placed.origin).inflated(inflation);
}

Result<ScenePartList> collect_scene_parts(const model::Scene& scene, const Sets& sets,
                                          Curves curves, const parallel::Context& context) {
  ScenePartList list;
  std::vector<std::uint32_t> first(scene.shapes.size() + 1, 0);
  for (std::size_t s = 0; s < scene.shapes.size(); ++s) {
    for (const geometry::Part& part : scene.shapes[s].parts) list.unique.push_back(&part);
    first[s + 1] = static_cast<std::uint32_t>(list.unique.size());
  }
  // Calls take(part, its number among those of the object, body) for each that can clash.
  const auto each = [&](std::size_t o, auto&& take) {
    if (!sets.in_a[o] && !sets.in_b[o]) return;
    std::uint32_t number = 0;
    for (std::size_t b = scene.first_body[o]; b < scene.first_body[o + 1]; ++b) {
      const std::vector<geometry::Part>& parts = scene.shapes[scene.bodies[b].grid_shape].parts;
      for (const geometry::Part& part : parts) {
        const bool wire = part.kind == geometry::PartKind::wire;
        if (wire ? curves == Curves::on : !part.triangles.empty())
          take(part, number, scene.bodies[b]);
        ++number;
      }
    }
  };
  const std::size_t objects = scene.first_body.empty() ? 0 : scene.first_body.size() - 1;
  auto parts = parallel::count_fill<ScenePart>(
      context, {.name = "list parts", .n = objects, .grain = kItemsPerBlock},
      [&](std::size_t o) {
        std::size_t count = 0;
        each(o, [&](const auto&, std::uint32_t, const model::GridBody&) { ++count; });
        return count;
      },
      [&](std::size_t o, std::span<ScenePart> out) {
        std::size_t at = 0;
        each(o, [&](const geometry::Part& part, std::uint32_t number, const model::GridBody& body) {
          const geometry::Part* const all = scene.shapes[body.grid_shape].parts.data();
          out[at++] = {{&part, body.origin},
                       static_cast<std::uint32_t>(o),
                       number,
                       first[body.grid_shape] + static_cast<std::uint32_t>(&part - all),
                       body.body};
        });
      });
  if (!parts) return parts.error();
  list.parts = std::move(parts->values);
  return list;
}

geometry::Box3d common_box_mm(const ScenePart& a, const ScenePart& b, double reach) {
  const geometry::Box3l common = inflated_box(a, reach).common(inflated_box(b, reach));
  return {geometry::to_mm(common.lo), geometry::to_mm(common.hi)};
}

Result<CandidatePairs> find_candidate_pairs(const ScenePartList& list, const Sets& sets,
                                            const SearchReach& reach, const Options& options,
                                            const parallel::Context& context) {
  const auto items = parallel::transform(
      context, {.name = "boxes", .n = list.parts.size(), .grain = kItemsPerBlock},
      [&](std::size_t i) { return item_of(list.parts[i], sets, reach); });
  if (!items) return items.error();
  auto found = box_pairs(*items, list, reach, options, context);
  if (!found) return found.error().code == ErrorCode::input ? too_many(options) : found.error();
  if (const Status s = put_in_order(*found, list, sets, context); !s) return s.error();
  return found;
}

std::vector<geometry::Box3l> object_boxes(const ScenePartList& list, const SearchReach& reach,
                                          std::size_t objects) {
  std::vector<geometry::Box3l> boxes(objects, geometry::empty_box<std::int64_t>());
  for (const ScenePart& part : list.parts)
    boxes[part.object].include(inflated_box(part, reach.of(part)));
  return boxes;
}

Result<CandidatePairs> find_pairs_of_cell(const ScenePartList& list, const Sets& sets,
                                          const SearchReach& reach, const Options& options,
                                          const Cell& cell, const parallel::Context& context) {
  const auto items = parallel::transform(
      context, {.name = "boxes", .n = list.parts.size(), .grain = kItemsPerBlock},
      [&](std::size_t i) { return item_of(list.parts[i], sets, reach); });
  if (!items) return items.error();
  const auto all = BoxPairs(*items, options, context).find(options.engine.max_pairs);
  if (!all) return all.error().code == ErrorCode::input ? too_many(options) : all.error();
  const std::vector<geometry::Box3l> boxes = object_boxes(list, reach, sets.in_a.size());
  auto own = parallel::collect<geometry::IndexPair>(
      context, {.name = "pairs of the cell", .n = all->size(), .grain = kItemsPerBlock},
      [&](std::size_t i, std::vector<geometry::IndexPair>& out) {
        const geometry::IndexPair& pair = (*all)[i];
        const geometry::Box3l& a = boxes[list.parts[pair.first].object];
        const geometry::Box3l& b = boxes[list.parts[pair.second].object];
        if (cell.contains(a.common(b).lo)) out.push_back(pair);
      });
  if (!own) return own.error();
  CandidatePairs found{std::move(*own), 0, false};
  found.boxes = found.pairs.size();
  if (const Status s = put_in_order(found, list, sets, context); !s) return s.error();
  return found;
}

Result<std::optional<CandidatePairs>> find_changed_pairs(const ScenePartList& list,
                                                         const Sets& sets, const SearchReach& reach,
                                                         std::span<const Change> change,
                                                         std::uint64_t limit,
                                                         const parallel::Context& context) {
  const auto items = parallel::transform(
      context, {.name = "boxes", .n = list.parts.size(), .grain = kItemsPerBlock},
      [&](std::size_t i) {
        geometry::BoxItem item = item_of(list.parts[i], sets, reach);
        // What has not changed is in one set, so that it makes no pairs of its own.
        item.sets = change[item.owner] == Change::changed ? geometry::kSetA | geometry::kSetB
                                                          : geometry::kSetB;
        return item;
      });
  if (!items) return items.error();
  const auto tree = geometry::SceneBvh::build(*items, context);
  if (!tree) return tree.error();
  auto pairs = geometry::overlapping_box_pairs(*tree, context, limit);
  if (!pairs) {
    if (pairs.error().code == ErrorCode::input) return std::optional<CandidatePairs>();
    return pairs.error();
  }
  CandidatePairs found;
  for (const geometry::IndexPair& pair : *pairs)
    if (are_compared(sets, list.parts[pair.first].object, list.parts[pair.second].object))
      found.pairs.push_back(pair);
  found.boxes = found.pairs.size();
  if (const Status s = put_in_order(found, list, sets, context); !s) return s.error();
  return std::optional(std::move(found));
}

Result<ObjectPairs> ObjectPairs::find(std::span<const geometry::IndexPair> pairs,
                                      const ScenePartList& list, const parallel::Context& context) {
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
