// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "cli/evaluate/cases.hpp"
#include "cli/evaluate/statistics.hpp"
#include "cli/evaluate/studies/loose_octree.hpp"
#include "cli/evaluate/studies/object_boxes.hpp"
#include "cli/evaluate/studies/study_runs.hpp"
#include "core/stopwatch.hpp"
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
    const Stopwatch watch;
    work();
    seconds.push_back(watch.seconds());
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

/// Queries a tree for the pairs of every box; stops early where it is requested to.
template <class Find>
TreeSearch search_all(std::size_t boxes, const std::stop_token& stop, const Find& find) {
  TreeSearch search;
  for (std::uint32_t i = 0; i < boxes && !stop.stop_requested(); ++i) find(i, search);
  return search;
}

/// A tree over the boxes of a ship.
struct TreeFigures {
  std::string name, ship;
  double build_s = 0, query_s = 0;
  std::optional<double> join_s;  ///< of a tree that can be joined with itself
  TreeSearch search;             ///< of all boxes
  std::string hash;              ///< of the pairs that it found
};

/// Has a tree answer the query of every box.
template <class Find>
void query(const StudyInput& input, std::size_t boxes, const Find& find, TreeFigures& figures) {
  figures.query_s = seconds_of(input.settings.repeat,
                               [&] { figures.search = search_all(boxes, input.stop, find); });
  figures.hash = computed_of(figures.search.pairs).hash();
}

TreeFigures figures_of_octree(const StudyInput& input, const std::vector<Box3l>& boxes) {
  TreeFigures figures;
  figures.name = "loose octree";
  figures.build_s =
      seconds_of(input.settings.repeat, [&] { const LooseOctree tree{std::span(boxes)}; });
  const LooseOctree tree{std::span(boxes)};
  query(
      input, boxes.size(), [&](std::uint32_t i, TreeSearch& search) { tree.find(i, search); },
      figures);
  return figures;
}

/// Returns the figures of the hierarchy over boxes; `joined` receives the hash of the pairs that
/// the engine finds by it.
Result<TreeFigures> figures_of_hierarchy(const StudyInput& input, const std::vector<Box3l>& boxes,
                                         std::string& joined) {
  std::vector<geometry::BoxItem> items(boxes.size());
  for (std::uint32_t i = 0; i < items.size(); ++i) items[i] = {.box = boxes[i], .owner = i};
  const parallel::Context context{.stop = input.stop};
  const auto tree = SceneBvh::build(items, context);
  if (!tree) return tree.error();
  Result<std::vector<IndexPair>> pairs = geometry::overlapping_box_pairs(*tree, context);
  if (!pairs) return pairs.error();
  joined = computed_of(std::move(*pairs)).hash();
  TreeFigures figures;
  figures.name = "boxes (BVH)";
  figures.build_s =
      seconds_of(input.settings.repeat, [&] { (void)SceneBvh::build(items, context); });
  figures.join_s = seconds_of(input.settings.repeat,
                              [&] { (void)geometry::overlapping_box_pairs(*tree, context); });
  query(
      input, boxes.size(),
      [&](std::uint32_t i, TreeSearch& search) { find_in_hierarchy(*tree, boxes, i, search); },
      figures);
  return figures;
}

void add_tree_row(const TreeFigures& tree, std::size_t objects, const std::string& joined,
                  StudyRecord& study) {
  const auto per_object = [&](std::uint64_t tests) {
    return fmt::format("{:.1f}", static_cast<double>(tests) / static_cast<double>(objects));
  };
  const bool same = tree.hash == joined;
  if (!same)
    study.differences.push_back(
        fmt::format("{}: the pairs of '{}' are not those of the join", tree.ship, tree.name));
  study.rows.push_back(
      {tree.ship, std::to_string(objects), tree.name, std::to_string(tree.search.pairs.size()),
       fmt::format("{:.3f}", tree.build_s), fmt::format("{:.3f}", tree.query_s),
       per_object(tree.search.node_tests), per_object(tree.search.box_tests),
       tree.join_s ? fmt::format("{:.3f}", *tree.join_s) : "-", same ? "yes" : "NO"});
}

/// Adds the rows of a ship: the hierarchy over boxes, and the octree.
Status add_ship(const StudyInput& input, const ShipCase& ship, StudyRecord& study) {
  input.narrate(fmt::format("octree, {}", ship.name));
  const auto placed = place_ship(clashing_ship(ship, input.settings.scale), {}, input.stop);
  if (!placed) return placed.error();
  const std::vector<Box3l> boxes = object_boxes(*placed, generate::Truth::kClearanceMm);
  std::string joined;
  Result<TreeFigures> hierarchy = figures_of_hierarchy(input, boxes, joined);
  if (!hierarchy) return hierarchy.error();
  TreeFigures octree = figures_of_octree(input, boxes);
  // What was stopped half way has pairs that mean nothing.
  if (input.stop.stop_requested()) return Error{ErrorCode::cancelled, "cancelled", {}, {}};
  for (TreeFigures* const tree : {&*hierarchy, &octree}) {
    tree->ship = ship.title;
    add_tree_row(*tree, boxes.size(), joined, study);
  }
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
