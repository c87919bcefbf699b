// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0061 says why there are trees of boxes, and no octree, spheres or fixed k-DOPs.

#include <cstdint>
#include <span>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/context.hpp"

// The BVH over the boxes of a scene, and the broad phase over it.

namespace strake::geometry {

/// Bits of BoxItem::sets.
inline constexpr std::uint8_t kSetA = 1;
inline constexpr std::uint8_t kSetB = 2;

/// The bounding box of an object, on the 64-bit grid.
struct BoxItem {
  Box3l box;
  std::uint32_t owner = 0;  ///< two items of one owner are never a pair
  std::uint8_t sets = kSetA | kSetB;
};

/// Two items, by index, first < second.
struct IndexPair {
  std::uint32_t first = 0, second = 0;
  friend bool operator==(const IndexPair&, const IndexPair&) = default;
  friend auto operator<=>(const IndexPair&, const IndexPair&) = default;
};

/// A bounding-volume hierarchy over all boxes of a scene, for finding the pairs that overlap.
///
///     const auto tree = SceneBvh::build(items, context);
///     const auto pairs = overlapping_box_pairs(*tree, context);
///
/// It is built top down by binned surface-area cost (Wald 2007). Nodes hold their boxes in 32 bits,
/// rounded outward; overlap is decided on the items' own 64-bit boxes, so the pairs do not depend
/// on the shape of the tree.
class SceneBvh {
 public:
  struct Node {
    Box3i box;
    std::uint32_t first = 0;  ///< inner: left child (right = first + 1); leaf: first of items()
    std::uint16_t count = 0;  ///< 0: inner node; otherwise items in the leaf
    std::uint8_t sets = 0;
  };

  /// Builds the tree. Empty boxes and items of no set belong to no pair. Errors: cancelled.
  [[nodiscard]] static Result<SceneBvh> build(std::span<const BoxItem> items,
                                              const parallel::Context& context);

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }  ///< root first
  /// Returns a node's box in the coordinates of the items, rounded outward.
  [[nodiscard]] Box3l box(const Node& node) const {
    Box3l box = node.box.as<std::int64_t>();
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = origin_[k] + (box.lo[k] << shift_);
      box.hi[k] = origin_[k] + (box.hi[k] << shift_);
    }
    return box;
  }
  [[nodiscard]] const std::vector<BoxItem>& items() const { return items_; }  ///< in leaf order
  /// Element k is the index that items()[k] had in the input.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  Vec3l origin_;   ///< of the nodes' boxes
  int shift_ = 0;  ///< how often the nodes' coordinates are halved
  std::vector<Node> nodes_;
  std::vector<BoxItem> items_;
  std::vector<std::uint32_t> order_;
};

/// Default limit on the number of pairs: 8 bytes each.
inline constexpr std::uint64_t kMaxPairs = std::uint64_t{1} << 32U;

/// Returns every pair of items of different owners, one of set A and one of set B, whose closed
/// boxes share a point: each unordered pair once, ascending.
///
/// n boxes at one place make n(n - 1)/2 pairs, which exceeds memory long before n is large: more
/// than `limit` pairs are an error (input), reported before they are stored.
[[nodiscard]] Result<std::vector<IndexPair>> overlapping_box_pairs(const SceneBvh& tree,
                                                                   const parallel::Context& context,
                                                                   std::uint64_t limit = kMaxPairs);

/// Returns the same pairs by the nested loop over A x B, flattened into one 64-bit range: the
/// reference for the tree, and the baseline of its benchmarks.
[[nodiscard]] Result<std::vector<IndexPair>> overlapping_box_pairs_brute_force(
    std::span<const BoxItem> items, const parallel::Context& context,
    std::uint64_t limit = kMaxPairs);

/// A second box for each item, in one of a few frames: tight for rotated, long and thin objects,
/// whose boxes along the coordinate axes all overlap.
struct BoxesInFrames {
  std::vector<Mat3d> frames;         ///< by rows: unit axes, perpendicular but for rounding
  Vec3l origin;                      ///< origin of the frames
  std::vector<std::uint32_t> frame;  ///< by item
  std::vector<Box3l> box;            ///< by item, in its frame, with a margin for rounding
};

/// Returns the pairs of overlapping_box_pairs() of the items' tree whose second boxes are not
/// separated either, neither by a face of one nor by a plane along an edge of each.
[[nodiscard]] Result<std::vector<IndexPair>> overlapping_box_pairs(std::span<const BoxItem> items,
                                                                   const BoxesInFrames& framed,
                                                                   const parallel::Context& context,
                                                                   std::uint64_t limit = kMaxPairs);

/// Returns the same pairs by the nested loop.
[[nodiscard]] Result<std::vector<IndexPair>> overlapping_box_pairs_brute_force(
    std::span<const BoxItem> items, const BoxesInFrames& framed, const parallel::Context& context,
    std::uint64_t limit = kMaxPairs);

}  // namespace strake::geometry
