// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/bvh/parallel_traversal.hpp"
#include "geometry/bvh/traversal.hpp"
#include "geometry/distance/bvh_in_frame.hpp"
#include "geometry/distance/triangle_distance.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/obb/rotated_part.hpp"

// Branch-and-bound traversal of two BVHs by distance, sequential and shared with a team.

namespace strake::geometry {

/// Two triangles and certain bounds on their squared distance.
struct NearTrianglePair {
  DistanceBounds squared;
  std::uint32_t a = 0, b = 0;
};

/// Visits the pairs of triangles of two parts that may be no farther apart than a reach, which may
/// shrink on the way: depth first, the nearer of two children first.
class DistanceTraversal {
 public:
  /// `near_enough`: see triangle_distance_bounds(). `aligned`: trees to use instead of the views'
  /// own.
  DistanceTraversal(const PairLocalPart& a, const PairLocalPart& b, QueryContext& work,
                    double near_enough = -1, const RotatedParts* aligned = nullptr)
      : a_(a),
        b_(b),
        boxes_a_(aligned == nullptr ? BvhInFrame(a) : BvhInFrame(aligned->a)),
        boxes_b_(aligned == nullptr ? BvhInFrame(b) : BvhInFrame(aligned->b)),
        work_(work),
        near_enough_(near_enough) {}

  /// Two nodes that may hold near triangles.
  struct Entry {
    NodePair pair;
    double squared = 0;  ///< distance of the nodes' boxes
  };

  /// Begins at the roots, or at an entry of rest(). `reach` is squared here and below.
  void start(double reach) {
    if (!tree_a().nodes().empty() && !tree_b().nodes().empty()) push(0, 0, reach);
  }
  void start(const Entry& entry) { stack_[size_++] = entry; }

  /// `visit(NearTrianglePair)` returns whether to go on. `reach` is read anew before each step. The
  /// traversal pauses after `limit` node pairs.
  template <class Visit>
  TraversalEnd run(const double& reach, Visit&& visit,
                   std::uint64_t limit = DualTraversal::kNoLimit) {
    for (; size_ > 0; --limit) {
      if (limit == 0) return TraversalEnd::left_off;
      const Entry entry = stack_[--size_];
      if (entry.squared > reach) continue;
      ++work_.node_pairs;
      if (!is_leaves(entry))
        open(entry, reach);
      else if (!leaves(entry.pair, reach, visit))
        return TraversalEnd::stopped;
    }
    return TraversalEnd::done;
  }

  /// Returns the remaining entries, split into at least `wanted` where possible.
  [[nodiscard]] std::vector<Entry> rest(double reach, std::size_t wanted) {
    std::vector<Entry> left(std::make_reverse_iterator(stack_.begin() + size_),
                            std::make_reverse_iterator(stack_.begin()));
    return expand_frontier(std::move(left), wanted,
                           [&](const Entry& entry, std::vector<Entry>& out) {
                             if (is_leaves(entry)) return false;
                             size_ = 0;
                             open(entry, reach);
                             while (size_ > 0) out.push_back(stack_[--size_]);
                             return true;
                           });
  }

 private:
  [[nodiscard]] const TriangleBvh& tree_a() const { return boxes_a_.tree(); }
  [[nodiscard]] const TriangleBvh& tree_b() const { return boxes_b_.tree(); }

  /// The triangles of a leaf, prepared; kept until another leaf is loaded.
  struct LoadedLeaf {
    std::uint32_t node = 0xffffffffU;
    std::uint32_t count = 0;
    std::array<std::uint32_t, TriangleBvh::kLeafSize> id{};
    std::array<DoubleTriangle, TriangleBvh::kLeafSize> triangle;
    std::array<Box3d, TriangleBvh::kLeafSize> box;  ///< in the frame of the traversal

    void load(const PairLocalPart& view, const BvhInFrame& boxes, std::uint32_t index) {
      if (node == index) return;
      node = index;
      const TriangleBvh::Node& leaf = boxes.tree().nodes()[index];
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
    const TriangleBvh::Node& na = tree_a().nodes()[entry.pair.a];
    const TriangleBvh::Node& nb = tree_b().nodes()[entry.pair.b];
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
        const DistanceBounds bounds = triangle_distance_bounds(a, b, reach, near_enough_);
        if (bounds.lower > reach) continue;
        if (!visit(NearTrianglePair{bounds, leaf_a_.id[i], leaf_b_.id[j]})) return false;
      }
    }
    return true;
  }

  const PairLocalPart &a_, &b_;
  BvhInFrame boxes_a_, boxes_b_;
  QueryContext& work_;
  double near_enough_;
  std::array<Entry, 2 * kMaxTreeDepth + 2> stack_;
  std::size_t size_ = 0;
  LoadedLeaf leaf_a_, leaf_b_;
};

/// Parts with up to so many triangles together are rotated after node_pairs_before_rotation() node
/// pairs; for larger ones flat faces are tried first. Rotated this early, pipes beside decks and
/// bulkheads of a turned model cost 2 to 3 times less.
inline constexpr std::size_t kRotatedEarly = 2048;

/// Returns the number of node pairs, of up to 16 pairs of triangles each, that take about as long
/// as rotating the parts.
[[nodiscard]] inline std::uint64_t node_pairs_before_rotation(const PairLocalPart& a,
                                                              const PairLocalPart& b) {
  return 32 + (a.part().triangles.size() + b.part().triangles.size()) / 4;
}

/// Returns the number of node pairs after which flat faces of slivers may be why a traversal takes
/// so long.
[[nodiscard]] inline std::uint64_t node_pairs_before_slabs(const PairLocalPart& a,
                                                           const PairLocalPart& b) {
  return 512 + (a.part().triangles.size() + b.part().triangles.size()) / 4;
}

/// Runs a DistanceTraversal that is shared with a team once it has proved heavy. After
/// node_pairs_before_rotation() or node_pairs_before_slabs() node pairs it starts again in a frame
/// along the parts' slivers, if there are such.
///
/// `begin()` makes the state of a subtask from what is known so far: `reach`, squared, which may
/// shrink, `work`, and operator()(NearTrianglePair) as DistanceTraversal's visitor. `take(state)`
/// gets the states in the order of a sequential traversal and returns whether to go on. Where the
/// team was stopped some are missing. `settled(state)` is called while the traversal is still
/// sequential, after node_pairs_before_slabs() node pairs and then each time that the number has
/// grown fourfold: true ends the walk. `limit`: see run_in_doubling_rounds().
template <class Begin, class Take, class Settled, class Most>
void adaptive_distance_traversal(const PairLocalPart& a, const PairLocalPart& b, double near_enough,
                                 QueryContext& work, const Begin& begin, const Take& take,
                                 const Settled& settled, const Most& limit) {
  using State = decltype(begin());
  const auto charge = [&](State& state) {
    work += state.work;
    return take(state);
  };
  std::optional<State> first(begin());
  std::optional<RotatedParts> aligned;
  std::optional<DistanceTraversal> traversal(std::in_place, a, b, first->work, near_enough);
  traversal->start(first->reach);
  std::uint64_t node_pairs_visited = 0;
  const auto turn = [&] {
    aligned = rotate_along_slivers(a, b, work.context());
    if (!aligned) return;
    // Start again: little is lost.
    work += first->work;
    first.emplace(begin());
    traversal.emplace(a, b, first->work, near_enough, &*aligned);
    traversal->start(first->reach);
  };
  bool heavy = true;
  const bool early = a.part().triangles.size() + b.part().triangles.size() <= kRotatedEarly;
  if (early) {
    heavy = traversal->run(first->reach, *first, node_pairs_before_rotation(a, b)) ==
            TraversalEnd::left_off;
    if (heavy) turn();
  }
  for (std::uint64_t pause = node_pairs_before_slabs(a, b);
       heavy && node_pairs_visited < kSequentialNodePairs; pause *= 4) {
    const std::uint64_t until = std::min(pause, kSequentialNodePairs);
    heavy = traversal->run(first->reach, *first, until - node_pairs_visited) ==
                TraversalEnd::left_off &&
            !settled(*first);
    if (heavy && node_pairs_visited == 0 && !early) turn();
    node_pairs_visited = until;
  }
  const double reach = first->reach;
  if (!charge(*first) || !heavy) return;
  const RotatedParts* const parts = aligned ? &*aligned : nullptr;
  (void)run_in_doubling_rounds(
      work.context(), traversal->rest(reach, kTraversalPieces),
      [&](std::size_t /*i*/) { return begin(); },
      [&](State& state, const DistanceTraversal::Entry& entry) {
        DistanceTraversal piece(a, b, state.work, near_enough, parts);
        piece.start(entry);
        piece.run(state.reach, state);
      },
      charge, limit);
}

template <class Begin, class Take, class Settled>
void adaptive_distance_traversal(const PairLocalPart& a, const PairLocalPart& b, double near_enough,
                                 QueryContext& work, const Begin& begin, const Take& take,
                                 const Settled& settled) {
  adaptive_distance_traversal(a, b, near_enough, work, begin, take, settled,
                              [](std::size_t /*done*/) { return kTraversalPieces; });
}

}  // namespace strake::geometry
