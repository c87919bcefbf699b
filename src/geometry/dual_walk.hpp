// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/pair_view.hpp"

namespace strake::geometry {

/// How a walk ended, or that it was left off.
enum class WalkEnd : std::uint8_t { done, stopped, left_off };

/// What a walk has on its stack, cut finer until there are at least so many entries or nothing is
/// left to open, in the order in which the walk would take them. `open(entry, out)` appends what is
/// below an entry in that order; false where there is nothing.
template <class Entry, class Open>
std::vector<Entry> opened(std::vector<Entry> entries, std::size_t wanted, const Open& open) {
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

/// Walks two trees at once, depth first, one side a step.
class DualWalk {
 public:
  static constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

  DualWalk(const PartTree& a, const PartTree& b) : a_(a), b_(b) {}

  /// Begins with the roots, or with one of rest().
  void start() {
    if (!a_.nodes().empty() && !b_.nodes().empty()) start({0, 0});
  }
  void start(const NodePair& pair) { stack_[size_++] = pair; }

  /// `near(node, node)` tells whether to look below the two; `leaves(leaf, leaf)` tells whether to
  /// go on. Left off after `most` node pairs.
  template <class Near, class Leaves>
  WalkEnd run(const Near& near, const Leaves& leaves, std::uint64_t most = kNoLimit) {
    for (; size_ > 0; --most) {
      if (most == 0) return WalkEnd::left_off;
      const NodePair pair = stack_[--size_];
      const PartTree::Node &na = a_.nodes()[pair.a], &nb = b_.nodes()[pair.b];
      if (!near(na, nb)) continue;
      if (na.count == 0 || nb.count == 0)
        open(pair);
      else if (!leaves(na, nb))
        return WalkEnd::stopped;
    }
    return WalkEnd::done;
  }

  /// What is left, in at least so many pieces where it has as many.
  template <class Near>
  [[nodiscard]] std::vector<NodePair> rest(const Near& near, std::size_t wanted) {
    std::vector<NodePair> left(std::make_reverse_iterator(stack_.begin() + size_),
                               std::make_reverse_iterator(stack_.begin()));
    return opened(std::move(left), wanted, [&](const NodePair& pair, std::vector<NodePair>& out) {
      const PartTree::Node &na = a_.nodes()[pair.a], &nb = b_.nodes()[pair.b];
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
    const PartTree::Node &na = a_.nodes()[pair.a], &nb = b_.nodes()[pair.b];
    if (open_first(na, nb)) {
      start({na.first + 1, pair.b});
      start({na.first, pair.b});
    } else {
      start({pair.a, nb.first + 1});
      start({pair.a, nb.first});
    }
  }

  const PartTree &a_, &b_;
  std::array<NodePair, 2 * kMaxTreeDepth + 2> stack_;
  std::size_t size_ = 0;
};

/// The whole walk, roots first. Whether it went to the end.
template <class Near, class Leaves>
bool walk_both(const PartTree& a, const PartTree& b, const Near& near, const Leaves& leaves) {
  DualWalk walk(a, b);
  walk.start();
  return walk.run(near, leaves) == WalkEnd::done;
}

}  // namespace strake::geometry
