// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "geometry/aligned_parts.hpp"
#include "geometry/box.hpp"
#include "geometry/boxed_tree.hpp"
#include "geometry/dual_walk.hpp"
#include "geometry/pair_view.hpp"
#include "geometry/triangle_distance.hpp"

namespace strake::geometry {

/// Two triangles and certain bounds on their squared distance.
struct NearTriangles {
  DistanceBounds squared;
  std::uint32_t a = 0, b = 0;
};

/// Pairs of triangles of two parts that may be no farther apart than a reach, which may shrink on
/// the way: depth first, the nearer of two children first.
class NearWalk {
 public:
  /// `near_enough`: see distance_bounds(). `aligned`: instead of the views' own trees.
  NearWalk(const PartView& a, const PartView& b, PairWork& work, double near_enough = -1,
           const AlignedParts* aligned = nullptr)
      : a_(a),
        b_(b),
        boxes_a_(aligned == nullptr ? BoxedTree(a) : BoxedTree(aligned->a)),
        boxes_b_(aligned == nullptr ? BoxedTree(b) : BoxedTree(aligned->b)),
        work_(work),
        near_enough_(near_enough) {}

  /// Two nodes that may hold near triangles.
  struct Entry {
    NodePair pair;
    double squared = 0;  ///< distance of the nodes' boxes
  };

  /// Begins with everything, or with one of rest(). `reach` is a square here and below.
  void start(double reach) {
    if (!tree_a().nodes().empty() && !tree_b().nodes().empty()) push(0, 0, reach);
  }
  void start(const Entry& entry) { stack_[size_++] = entry; }

  /// `visit(NearTriangles)` tells whether to go on. `reach` is read anew before each step. Left off
  /// after `most` node pairs.
  template <class Visit>
  WalkEnd run(const double& reach, Visit&& visit, std::uint64_t most = DualWalk::kNoLimit) {
    for (; size_ > 0; --most) {
      if (most == 0) return WalkEnd::left_off;
      const Entry entry = stack_[--size_];
      if (entry.squared > reach) continue;
      ++work_.node_pairs;
      if (!is_leaves(entry))
        open(entry, reach);
      else if (!leaves(entry.pair, reach, visit))
        return WalkEnd::stopped;
    }
    return WalkEnd::done;
  }

  /// What is left, in at least so many pieces where it has as many.
  [[nodiscard]] std::vector<Entry> rest(double reach, std::size_t wanted) {
    std::vector<Entry> left(std::make_reverse_iterator(stack_.begin() + size_),
                            std::make_reverse_iterator(stack_.begin()));
    return opened(std::move(left), wanted, [&](const Entry& entry, std::vector<Entry>& out) {
      if (is_leaves(entry)) return false;
      size_ = 0;
      open(entry, reach);
      while (size_ > 0) out.push_back(stack_[--size_]);
      return true;
    });
  }

 private:
  [[nodiscard]] const PartTree& tree_a() const { return boxes_a_.tree(); }
  [[nodiscard]] const PartTree& tree_b() const { return boxes_b_.tree(); }

  /// The triangles of a leaf, prepared; kept until another leaf is loaded.
  struct LoadedLeaf {
    std::uint32_t node = 0xffffffffU;
    std::uint32_t count = 0;
    std::array<std::uint32_t, PartTree::kLeafSize> id{};
    std::array<DoubleTriangle, PartTree::kLeafSize> triangle;
    std::array<Box3d, PartTree::kLeafSize> box;  ///< in the frame of the walk

    void load(const PartView& view, const BoxedTree& boxes, std::uint32_t index) {
      if (node == index) return;
      node = index;
      const PartTree::Node& leaf = boxes.tree().nodes()[index];
      count = leaf.count;
      for (std::uint32_t i = 0; i < count; ++i) {
        id[i] = boxes.tree().order()[leaf.first + i];
        triangle[i] = DoubleTriangle(view.corners(id[i]));
        box[i] = boxes.box(id[i], triangle[i]);
      }
    }
  };

  [[nodiscard]] bool is_leaves(const Entry& entry) const {
    return tree_a().nodes()[entry.pair.a].count != 0 && tree_b().nodes()[entry.pair.b].count != 0;
  }

  void push(std::uint32_t a, std::uint32_t b, double reach) {
    const double squared = squared_gap(boxes_a_.box(a), boxes_b_.box(b));
    if (squared <= reach) stack_[size_++] = {{a, b}, squared};
  }

  void open(const Entry& entry, double reach) {
    const PartTree::Node& na = tree_a().nodes()[entry.pair.a];
    const PartTree::Node& nb = tree_b().nodes()[entry.pair.b];
    const std::size_t before = size_;
    if (open_first(na, nb)) {
      push(na.first + 1, entry.pair.b, reach);
      push(na.first, entry.pair.b, reach);
    } else {
      push(entry.pair.a, nb.first + 1, reach);
      push(entry.pair.a, nb.first, reach);
    }
    if (size_ == before + 2 && stack_[size_ - 1].squared > stack_[size_ - 2].squared)
      std::swap(stack_[size_ - 1], stack_[size_ - 2]);
  }

  template <class Visit>
  bool leaves(const NodePair& pair, const double& reach, Visit& visit) {
    leaf_a_.load(a_, boxes_a_, pair.a);
    leaf_b_.load(b_, boxes_b_, pair.b);
    const Box3d box_a = boxes_a_.box(pair.a);
    for (std::uint32_t j = 0; j < leaf_b_.count; ++j) {
      const DoubleTriangle& b = leaf_b_.triangle[j];
      if (squared_gap(box_a, leaf_b_.box[j]) > reach) continue;
      for (std::uint32_t i = 0; i < leaf_a_.count; ++i) {
        const DoubleTriangle& a = leaf_a_.triangle[i];
        if (squared_gap(leaf_a_.box[i], leaf_b_.box[j]) > reach) continue;
        ++work_.triangle_pairs;
        const DistanceBounds bounds = distance_bounds(a, b, reach, near_enough_);
        if (bounds.lower > reach) continue;
        if (!visit(NearTriangles{bounds, leaf_a_.id[i], leaf_b_.id[j]})) return false;
      }
    }
    return true;
  }

  const PartView &a_, &b_;
  BoxedTree boxes_a_, boxes_b_;
  PairWork& work_;
  double near_enough_;
  std::array<Entry, 2 * kMaxTreeDepth + 2> stack_;
  std::size_t size_ = 0;
  LoadedLeaf leaf_a_, leaf_b_;
};

}  // namespace strake::geometry
