// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"

// Traversals of one BVH, and of two at once.

namespace strake::geometry {

/// Calls visit(triangle) for the triangles of a part's tree below the nodes for which `near(node)`
/// holds, until it returns false; depth first, the last child first. Returns whether it never did.
template <class Near, class Visit>
bool traverse_bvh(const TriangleBvh& tree, const Near& near, const Visit& visit) {
  const auto& nodes = tree.nodes();
  std::array<std::uint32_t, kMaxTreeDepth + 2> stack;
  std::size_t size = 0;
  if (!nodes.empty()) stack[size++] = 0;
  while (size > 0) {
    const TriangleBvh::Node& node = nodes[stack[--size]];
    if (!near(node)) continue;
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = 0; i < node.count; ++i)
      if (!visit(tree.order()[node.first + i])) return false;
  }
  return true;
}

/// Calls visit(triangle) for a part's tree, depth first, the nearer of two children first.
/// `bound(node index)` is a lower bound on the distance of a node; where `beyond(bound)` holds by
/// now, the node is skipped.
template <class Bound, class Beyond, class Visit>
void traverse_nearest_first(const TriangleBvh& tree, const Bound& bound, const Beyond& beyond,
                            const Visit& visit) {
  const auto& nodes = tree.nodes();
  std::array<std::pair<std::uint32_t, double>, kMaxTreeDepth + 2> stack;
  std::size_t size = 0;
  if (!nodes.empty()) stack[size++] = {0, bound(0)};
  while (size > 0) {
    const auto [index, nearest] = stack[--size];
    if (beyond(nearest)) continue;
    const TriangleBvh::Node& node = nodes[index];
    if (node.count != 0) {
      for (std::uint32_t i = 0; i < node.count; ++i) visit(tree.order()[node.first + i]);
      continue;
    }
    std::pair near{node.first, bound(node.first)}, far{node.first + 1, bound(node.first + 1)};
    if (far.second < near.second) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
}

/// How a traversal ended, or that it was paused.
enum class TraversalEnd : std::uint8_t { done, stopped, left_off };

/// Returns the stack of a traversal, expanded until it has at least `wanted` entries or none can be
/// expanded, in the order of the traversal. `open(entry, out)` appends the children of an entry in
/// that order; false where there are none.
template <class Entry, class Open>
std::vector<Entry> expand_frontier(std::vector<Entry> entries, std::size_t wanted,
                                   const Open& open) {
  for (bool finer = true; finer && entries.size() < wanted;) {
    finer = false;
    std::vector<Entry> next;
    for (const Entry& entry : entries) {
      if (open(entry, next))
        finer = true;
      else
        next.push_back(entry);
    }
    entries = std::move(next);
  }
  return entries;
}

/// Traverses two trees at once, depth first, descending one side per step.
class DualTraversal {
 public:
  static constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

  DualTraversal(const TriangleBvh& a, const TriangleBvh& b) : a_(a), b_(b) {}

  /// Begins at the roots, or at an entry of rest().
  void start() {
    if (!a_.nodes().empty() && !b_.nodes().empty()) start({0, 0});
  }
  void start(const NodePair& pair) { stack_[size_++] = pair; }

  /// `near(node, node)` returns whether to descend; `leaves(leaf, leaf)` returns whether to go on.
  /// The traversal pauses after `limit` node pairs.
  template <class Near, class Leaves>
  TraversalEnd run(const Near& near, const Leaves& leaves, std::uint64_t limit = kNoLimit) {
    for (; size_ > 0; --limit) {
      if (limit == 0) return TraversalEnd::left_off;
      const NodePair pair = stack_[--size_];
      const TriangleBvh::Node &na = a_.nodes()[pair.a], &nb = b_.nodes()[pair.b];
      if (!near(na, nb)) continue;
      if (na.count == 0 || nb.count == 0)
        open(pair);
      else if (!leaves(na, nb))
        return TraversalEnd::stopped;
    }
    return TraversalEnd::done;
  }

  /// Returns the remaining entries, split into at least `wanted` where possible.
  template <class Near>
  [[nodiscard]] std::vector<NodePair> rest(const Near& near, std::size_t wanted) {
    std::vector<NodePair> left(std::make_reverse_iterator(stack_.begin() + size_),
                               std::make_reverse_iterator(stack_.begin()));
    return expand_frontier(
        std::move(left), wanted, [&](const NodePair& pair, std::vector<NodePair>& out) {
          const TriangleBvh::Node &na = a_.nodes()[pair.a], &nb = b_.nodes()[pair.b];
          if (na.count != 0 && nb.count != 0) return false;
          if (!near(na, nb)) return true;
          size_ = 0;
          open(pair);
          while (size_ > 0) out.push_back(stack_[--size_]);
          return true;
        });
  }

 private:
  void open(const NodePair& pair) {
    const TriangleBvh::Node &na = a_.nodes()[pair.a], &nb = b_.nodes()[pair.b];
    if (open_first(na, nb)) {
      start({na.first + 1, pair.b});
      start({na.first, pair.b});
    } else {
      start({pair.a, nb.first + 1});
      start({pair.a, nb.first});
    }
  }

  const TriangleBvh &a_, &b_;
  std::array<NodePair, 2 * kMaxTreeDepth + 2> stack_;
  std::size_t size_ = 0;
};

/// Runs the whole traversal from the roots. Returns whether it went to the end.
template <class Near, class Leaves>
bool traverse_both(const TriangleBvh& a, const TriangleBvh& b, const Near& near,
                   const Leaves& leaves) {
  DualTraversal traversal(a, b);
  traversal.start();
  return traversal.run(near, leaves) == TraversalEnd::done;
}

}  // namespace strake::geometry
