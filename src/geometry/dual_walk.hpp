// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "geometry/pair_view.hpp"

namespace strake::geometry {

/// Walks two trees at once, depth first, one side a step. `near(node, node)` tells whether to look
/// below the two, and sees the pair of roots first; `leaves(leaf, leaf)` tells whether to go on.
/// Whether it always did.
template <class Near, class Leaves>
bool walk_both(const PartTree& a, const PartTree& b, const Near& near, const Leaves& leaves) {
  if (a.nodes().empty() || b.nodes().empty()) return true;
  std::array<NodePair, 2 * kMaxTreeDepth + 2> stack;
  std::size_t size = 0;
  stack[size++] = {0, 0};
  while (size > 0) {
    const NodePair pair = stack[--size];
    const PartTree::Node &na = a.nodes()[pair.a], &nb = b.nodes()[pair.b];
    if (!near(na, nb)) continue;
    if (na.count != 0 && nb.count != 0) {
      if (!leaves(na, nb)) return false;
    } else if (open_first(na, nb)) {
      stack[size++] = {na.first + 1, pair.b};
      stack[size++] = {na.first, pair.b};
    } else {
      stack[size++] = {pair.a, nb.first + 1};
      stack[size++] = {pair.a, nb.first};
    }
  }
  return true;
}

}  // namespace strake::geometry
