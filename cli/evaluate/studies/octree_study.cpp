// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cli/evaluate/cases.hpp"
#include "cli/evaluate/statistics.hpp"
#include "cli/evaluate/studies/loose_octree.hpp"
#include "cli/evaluate/studies/object_boxes.hpp"
#include "cli/evaluate/studies/study_runs.hpp"
#include "geometry/bvh/scene_bvh.hpp"
#include "strake/generate/ship.hpp"

namespace strake::cli {

namespace {

using geometry::Box3l;
using geometry::IndexPair;
using geometry::SceneBvh;

/// Returns the seconds of a piece of work, as the median of so many rounds.
template <class Work>
double seconds_of(std::uint64_t rounds, const Work& work) {
  std::vector<double> seconds;
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    work();
    seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return median(std::move(seconds));
}

/// Finds the boxes of higher numbers that share a point with a box, by the same query as
/// LooseOctree::find().
void find_in_hierarchy(const SceneBvh& tree, const std::vector<Box3l>& boxes, std::uint32_t item,
                       TreeSearch& search) {
  const Box3l& box = boxes[item];
  if (box.empty()) return;
  search.stack.push_back(0);
  while (!search.stack.empty()) {
    const SceneBvh::Node& node = tree.nodes()[search.stack.back()];
    search.stack.pop_back();
    ++search.node_tests;
    if (!meet(box, tree.box(node))) continue;
    if (node.count == 0) {
      search.stack.push_back(node.first);
      search.stack.push_back(node.first + 1);
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const std::uint32_t other = tree.order()[k];
      if (other <= item) continue;
      ++search.box_tests;
      if (meet(box, tree.items()[k].box)) search.pairs.push_back({item, other});
    }
  }
}

/// Asks a tree for the pairs of every box; stops early where it is asked to.
template <class Find>
TreeSearch search_all(std::size_t boxes, const std::stop_token& stop, const Find& find) {
  TreeSearch search;
  for (std::uint32_t i = 0; i < boxes && !stop.stop_requested(); ++i) find(i, search);
  return search;
}

/// One tree over the boxes of a ship.
struct TreeFigures {
  double build_s = 0, query_s = 0;
  TreeSearch search;
};

TreeFigures figures_of_octree(const StudyInput& input, const std::vector<Box3l>& boxes) {
  TreeFigures figures;
  figures.build_s =
      seconds_of(input.settings.repeat, [&] { const LooseOctree tree{std::span(boxes)}; });
  const LooseOctree tree{std::span(boxes)};
  figures.query_s = seconds_of(input.settings.repeat, [&] {
    figures.search = search_all(boxes.size(), input.stop,
                                [&](std::uint32_t i, TreeSearch& search) { tree.find(i, search); });
  });
  return figures;
}

TreeFigures figures_of_bvh(const StudyInput& input, const std::vector<Box3l>& boxes,
                           const SceneBvh& tree) {
  TreeFigures figures;
  figures.query_s = seconds_of(input.settings.repeat, [&] {
    figures.search = search_all(boxes.size(), input.stop, [&](std::uint32_t i, TreeSearch& search) {
      find_in_hierarchy(tree, boxes, i, search);
    });
  });
  return figures;
}

void add_tree_row(const std::string& ship, const std::string& tree, const TreeFigures& figures,
                  const std::string& join, std::string same, std::size_t objects,
                  StudyRecord& study) {
  const auto per_object = [&](std::uint64_t tests) {
    return fmt::format("{:.1f}", static_cast<double>(tests) / static_cast<double>(objects));
  };
  study.rows.push_back(
      {ship, std::to_string(objects), tree, std::to_string(figures.search.pairs.size()),
       fmt::format("{:.3f}", figures.build_s), fmt::format("{:.3f}", figures.query_s),
       per_object(figures.search.node_tests), per_object(figures.search.box_tests), join,
       std::move(same)});
}

/// Adds the rows of a ship: the hierarchy over boxes with the join that the engine uses, and the
/// octree.
Status add_ship(const StudyInput& input, const ShipCase& ship, StudyRecord& study) {
  input.narrate(fmt::format("octree, {}", ship.name));
  const auto placed = place_ship(clashing_ship(ship, input.settings.scale), {}, input.stop);
  if (!placed) return placed.error();
  const std::vector<Box3l> boxes = object_boxes(*placed, generate::Truth::kClearanceMm);
  std::vector<geometry::BoxItem> items(boxes.size());
  for (std::uint32_t i = 0; i < items.size(); ++i) items[i] = {.box = boxes[i], .owner = i};
  const parallel::Context context{.stop = input.stop};
  auto tree = SceneBvh::build(items, context);
  if (!tree) return tree.error();
  const double build_s =
      seconds_of(input.settings.repeat, [&] { (void)SceneBvh::build(items, context); });
  Result<std::vector<IndexPair>> joined = geometry::overlapping_box_pairs(*tree, context);
  if (!joined) return joined.error();
  const double join_s = seconds_of(input.settings.repeat,
                                   [&] { (void)geometry::overlapping_box_pairs(*tree, context); });
  TreeFigures bvh = figures_of_bvh(input, boxes, *tree);
  bvh.build_s = build_s;
  const TreeFigures octree = figures_of_octree(input, boxes);
  if (input.stop.stop_requested()) return Error{ErrorCode::cancelled, "cancelled", {}, {}};
  const std::string expected = computed_of(std::move(*joined)).hash();
  const auto same = [&](const TreeFigures& figures, const char* which) -> std::string {
    if (computed_of(figures.search.pairs).hash() == expected) return "yes";
    study.differences.push_back(
        fmt::format("the pairs of the {} are not those of the join: {}", which, ship.name));
    return "NO";
  };
  const std::string title(ship.title);
  add_tree_row(title, "boxes (BVH)", bvh, fmt::format("{:.3f}", join_s), same(bvh, "queries"),
               boxes.size(), study);
  add_tree_row(title, "loose octree", octree, "-", same(octree, "octree"), boxes.size(), study);
  return {};
}

}  // namespace

Status study_octree(const StudyInput& input, StudyRecord& study) {
  study.columns = {"Ship",
                   "Objects",
                   "Tree",
                   "Pairs",
                   "Build s",
                   "Query s",
                   "Node tests per object",
                   "Box tests per object",
                   "Join s",
                   "Equal"};
  for (const ShipCase& ship : ship_cases())
    if (const Status status = add_ship(input, ship, study); !status) return status;
  return {};
}

}  // namespace strake::cli
