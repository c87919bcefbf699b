// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "geometry/pair_view.hpp"

namespace strake::geometry {

/// Calls visit(triangle) for the triangles of a part's tree below whose nodes `near(node)` lets it
/// look, until it returns false; depth first, the last child first. Whether it never did.
template <class Near, class Visit>
bool walk_tree(const PartTree& tree, const Near& near, const Visit& visit) {
  const auto& nodes = tree.nodes();
  std::array<std::uint32_t, kMaxTreeDepth + 2> stack;
  std::size_t size = 0;
  if (!nodes.empty()) stack[size++] = 0;
  while (size > 0) {
    const PartTree::Node& node = nodes[stack[--size]];
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

/// Calls visit(triangle) by a part's tree, depth first, the nearer of two children first.
/// `bound(node index)` is how near a node may be; `beyond(bound)` tells whether that is out of
/// reach by now: then the node is left out.
template <class Bound, class Beyond, class Visit>
void walk_nearer_first(const PartTree& tree, const Bound& bound, const Beyond& beyond,
                       const Visit& visit) {
  const auto& nodes = tree.nodes();
  std::array<std::pair<std::uint32_t, double>, kMaxTreeDepth + 2> stack;
  std::size_t size = 0;
  if (!nodes.empty()) stack[size++] = {0, bound(0)};
  while (size > 0) {
    const auto [index, nearest] = stack[--size];
    if (beyond(nearest)) continue;
    const PartTree::Node& node = nodes[index];
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

}  // namespace strake::geometry
