// SPDX-License-Identifier: Apache-2.0
#include "clash/incremental/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "clash/rules/options.hpp"
#include "geometry/bvh/scene_bvh.hpp"
#include "strake/parallel/reduce.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::clash {
namespace {

using geometry::Box3l;
using geometry::SceneBvh;

/// What the parts of a shape that are tested have in common.
struct ShapeExtent {
  geometry::Box3i box = geometry::empty_box<std::int32_t>();
  double sag = 0;  ///< the largest
  std::uint32_t parts = 0;
  bool unknown_sag = false;
};

ShapeExtent extent_of(const model::GridShape& shape, Curves curves) {
  ShapeExtent extent;
  for (const geometry::Part& part : shape.parts) {
    const bool wire = part.kind == geometry::PartKind::wire;
    if (wire ? curves == Curves::off : part.triangles.empty()) continue;
    extent.box.include(part.box);
    extent.sag = std::max(extent.sag, part.sag);
    extent.unknown_sag = extent.unknown_sag || part.flags.unknown_sag;
    ++extent.parts;
  }
  return extent;
}

/// Whether a box meets one of a tree's items. Both have to be of some set for the tree.
bool meets_any(const SceneBvh& tree, const Box3l& box, std::vector<std::uint32_t>& stack) {
  if (tree.nodes().empty()) return false;
  stack.assign(1, 0);
  while (!stack.empty()) {
    const SceneBvh::Node& node = tree.nodes()[stack.back()];
    stack.pop_back();
    if (!tree.box(node).meets(box)) continue;
    if (node.count == 0) {
      stack.push_back(node.first);
      stack.push_back(node.first + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (tree.items()[i].box.meets(box)) return true;
  }
  return false;
}

/// What the pass adds up, and memory that its searches share.
struct Totals {
  std::uint64_t parts = 0;
  float widest_precision_um = 0;
  std::vector<std::uint8_t> unknown_sag;
  std::vector<std::uint32_t> stack = {};
};

class NeighbourSearch {
 public:
  NeighbourSearch(const model::Scene& scene, const Sets& sets, const Options& options,
                  const SearchReach& reach, const ObjectMap& map, const parallel::Context& context)
      : scene_(scene),
        sets_(sets),
        options_(options),
        reach_(reach),
        map_(map),
        context_(context) {}

  Result<Neighbours> run() {
    auto extents = parallel::transform(
        context_, {.name = "extents of shapes", .n = scene_.shapes.size(), .grain = 256},
        [&](std::size_t s) { return extent_of(scene_.shapes[s], options_.engine.curves); });
    if (!extents) return extents.error();
    extents_ = std::move(*extents);
    auto tree = SceneBvh::build(changed_boxes(), context_);
    if (!tree) return tree.error();
    Neighbours found;
    found.change.assign(map_.before.size(), Change::none);
    auto totals = pass(*tree, found.change);
    if (!totals) return totals.error();
    found.parts = totals->parts;
    found.widest_precision_um = totals->widest_precision_um;
    found.unknown_sag = std::move(totals->unknown_sag);
    for (std::uint32_t o = 0; o < found.change.size(); ++o)
      if (found.change[o] != Change::none) found.tested.push_back(o);
    return found;
  }

 private:
  [[nodiscard]] bool is_changed(std::size_t o) const { return map_.before[o] == model::kNoObject; }
  [[nodiscard]] bool is_tested(std::size_t o) const { return sets_.in_a[o] || sets_.in_b[o]; }
  [[nodiscard]] float precision(const model::GridBody& body) const {
    return scene_.model->bodies[body.body].precision_um;
  }

  /// Returns a box that holds inflated_box() of every part of a body.
  [[nodiscard]] Box3l box_of(const model::GridBody& body, const ShapeExtent& extent,
                             std::size_t object, float precision_um) const {
    const double of_object = reach_.of_object.empty() ? 0 : reach_.of_object[object];
    const double beyond = extent.sag + static_cast<double>(coarse_step(options_, precision_um));
    const double inflation = std::ceil(reach_.of_all / 2 + of_object + beyond) + 1;
    return extent.box.as<std::int64_t>()
        .moved(body.origin)
        .inflated(static_cast<std::int64_t>(inflation));
  }

  [[nodiscard]] std::vector<geometry::BoxItem> changed_boxes() const {
    std::vector<geometry::BoxItem> items;
    if (map_.changed == 0) return items;
    for (std::uint32_t o = 0; o < map_.before.size(); ++o) {
      if (!is_changed(o) || !is_tested(o)) continue;
      for (const model::GridBody& body : scene_.bodies_of(model::ObjectId{o})) {
        const ShapeExtent& extent = extents_[body.grid_shape];
        if (extent.parts > 0)
          items.push_back({.box = box_of(body, extent, o, precision(body)), .owner = o});
      }
    }
    return items;
  }

  /// Looks at each body once: sets what became of each object, and adds up what is said of all.
  [[nodiscard]] Result<Totals> pass(const SceneBvh& tree, std::vector<Change>& change) const {
    // Only shares the work out: between 2048 and 32'768 no difference can be seen (decision 0073).
    constexpr std::size_t kGrain = 8192;
    return parallel::reduce(
        context_, {.name = "neighbours of changes", .n = change.size(), .grain = kGrain},
        Totals{.unknown_sag = std::vector<std::uint8_t>(scene_.model->files.size(), 0)},
        [&](Totals& totals, std::size_t o) {
          if (is_changed(o)) change[o] = Change::changed;
          if (!is_tested(o)) return;
          bool near = is_changed(o) || tree.nodes().empty();  // then it need not be looked for
          for (const model::GridBody& body :
               scene_.bodies_of(model::ObjectId{static_cast<std::uint32_t>(o)})) {
            const ShapeExtent& extent = extents_[body.grid_shape];
            if (extent.parts == 0) continue;
            const float precision_um = precision(body);
            totals.parts += extent.parts;
            totals.widest_precision_um = std::max(totals.widest_precision_um, precision_um);
            if (extent.unknown_sag) totals.unknown_sag[scene_.model->objects[o].file] = 1;
            if (near) continue;
            near = meets_any(tree, box_of(body, extent, o, precision_um), totals.stack);
            if (near) change[o] = Change::near;
          }
        },
        [](Totals& into, const Totals& partial) {
          into.parts += partial.parts;
          into.widest_precision_um =
              std::max(into.widest_precision_um, partial.widest_precision_um);
          for (std::size_t f = 0; f < into.unknown_sag.size(); ++f)
            into.unknown_sag[f] |= partial.unknown_sag[f];
        });
  }

  const model::Scene& scene_;
  const Sets& sets_;
  const Options& options_;
  const SearchReach& reach_;
  const ObjectMap& map_;
  const parallel::Context& context_;
  std::vector<ShapeExtent> extents_;  ///< by shape
};

}  // namespace

Result<Neighbours> find_neighbours(const model::Scene& scene, const Sets& sets,
                                   const Options& options, const SearchReach& reach,
                                   const ObjectMap& map, const parallel::Context& context) {
  return NeighbourSearch(scene, sets, options, reach, map, context).run();
}

}  // namespace strake::clash
