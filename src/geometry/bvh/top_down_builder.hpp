// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0059 says what differs from bvh v2 here, and why.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/bvh/parallel_traversal.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/order.hpp"
#include "strake/parallel/transform.hpp"

namespace strake::geometry {

/// The split of a range of items: neither half is empty.
struct RangeSplit {
  std::uint32_t first = 0;  ///< number of items in the first half
  Box3i left, right;        ///< boxes of the items of either half
};

/// The items [first, last) below a node, `depth` levels below the root.
struct BuildRange {
  std::uint32_t node = 0, first = 0, last = 0, depth = 0;

  [[nodiscard]] std::uint32_t size() const { return last - first; }
};

/// Builds a binary tree of boxes over items by splitting ranges of them in two, down to leaves.
///
/// Node has a box, `first` and `count`: in an inner node count is 0 and first is its left child
/// (right = left + 1), in a leaf they are its items. `cut(range, box)` parts the items of a range
/// and returns where it was split; what it leaves open is the order within the halves, so that
/// `settle(range)` puts those of a leaf in one. Both are called for disjoint ranges at once.
template <class Node, class Cut, class Settle>
class TopDownBuilder {
 public:
  TopDownBuilder(std::uint32_t leaf_size, const Cut& cut, const Settle& settle)
      : leaf_size_(leaf_size), cut_(cut), settle_(settle) {}

  /// Returns the nodes over items [0, n), root first: the same for any team. A team splits many
  /// items level by level, then each worker builds whole subtrees. None where it was cancelled.
  [[nodiscard]] std::vector<Node> run(const Box3i& box, std::uint32_t n,
                                      const parallel::Context& context) {
    const BuildRange all{0, 0, n, 0};
    std::vector<Node> nodes;
    nodes.reserve(std::size_t{4} * n / leaf_size_);
    nodes.push_back({box, 0, 0});
    if (n < kParallelThreshold)
      finish(nodes, all);
    else if (!finish_together(nodes, all, context))
      nodes.clear();
    return nodes;
  }

 private:
  /// One worker builds the subtree of a range of at most this many items. Between 2048 and 32'768
  /// no difference can be seen (decision 0073).
  static constexpr std::uint32_t kPiece = std::uint32_t{1} << 13U;

  bool ends_at(std::vector<Node>& nodes, const BuildRange& range) const {
    if (range.size() > leaf_size_) return false;
    settle_(range);
    nodes[range.node].first = range.first;
    nodes[range.node].count = range.size();
    return true;
  }

  /// Appends the two children of a node, the left one first.
  std::pair<BuildRange, BuildRange> open(std::vector<Node>& nodes, const BuildRange& range,
                                         const RangeSplit& halves) const {
    const auto left = static_cast<std::uint32_t>(nodes.size());
    const std::uint32_t middle = range.first + halves.first;
    nodes[range.node].first = left;
    nodes.push_back({halves.left, 0, 0});
    nodes.push_back({halves.right, 0, 0});
    return {{left, range.first, middle, range.depth + 1},
            {left + 1, middle, range.last, range.depth + 1}};
  }

  void finish(std::vector<Node>& nodes, const BuildRange& all) const {
    std::vector<BuildRange> todo{all};
    while (!todo.empty()) {
      const BuildRange range = todo.back();
      todo.pop_back();
      if (ends_at(nodes, range)) continue;
      const auto [left, right] = open(nodes, range, cut_(range, nodes[range.node].box));
      todo.push_back(right);
      todo.push_back(left);
    }
  }

  Status finish_together(std::vector<Node>& nodes, const BuildRange& all,
                         const parallel::Context& context) const {
    std::vector<BuildRange> level{all}, pieces;
    while (!level.empty()) {
      const auto halves = parallel::transform(
          context, {.name = "tree levels", .n = level.size()},
          [&](std::size_t i) { return cut_(level[i], nodes[level[i].node].box); });
      if (!halves) return halves.error();
      std::vector<BuildRange> next;
      for (std::size_t i = 0; i < level.size(); ++i) {
        const auto [left, right] = open(nodes, level[i], (*halves)[i]);
        for (const BuildRange& child : {left, right})
          (child.size() > kPiece ? next : pieces).push_back(child);
      }
      level = std::move(next);
    }
    return build_subtrees(nodes, pieces, context);
  }

  /// Builds the subtrees in parallel and joins them.
  Status build_subtrees(std::vector<Node>& nodes, const std::vector<BuildRange>& pieces,
                        const parallel::Context& context) const {
    const auto order =
        parallel::longest_first(pieces.size(), [&](std::size_t i) { return pieces[i].size(); });
    const auto grown = parallel::transform(
        context, {.name = "tree pieces", .n = pieces.size(), .order = order}, [&](std::size_t i) {
          BuildRange root = pieces[i];
          std::vector<Node> own{nodes[root.node]};
          root.node = 0;
          own.reserve(root.size());
          finish(own, root);
          return own;
        });
    if (!grown) return grown.error();
    std::vector<std::uint32_t> start(pieces.size());
    auto end = static_cast<std::uint32_t>(nodes.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      start[i] = end;
      end += static_cast<std::uint32_t>((*grown)[i].size()) - 1;
    }
    nodes.resize(end);
    return parallel::for_each(
        context, {.name = "tree nodes", .n = pieces.size(), .order = order}, [&](std::size_t i) {
          const std::vector<Node>& own = (*grown)[i];
          for (std::size_t k = 0; k < own.size(); ++k) {
            Node& node = k == 0 ? nodes[pieces[i].node] : nodes[start[i] + k - 1];
            node = own[k];
            // The root of a subtree is stored already: its children follow from 0 on.
            if (node.count == 0) node.first = start[i] + own[k].first - 1;
          }
        });
  }

  std::uint32_t leaf_size_;
  const Cut& cut_;
  const Settle& settle_;
};

}  // namespace strake::geometry
