// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/bvh/scene_bvh.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::cli {

/// The work of queries of a tree, one after another: pairs found, tests made.
struct TreeSearch {
  std::vector<geometry::IndexPair> pairs;
  std::uint64_t node_tests = 0, box_tests = 0;
  std::vector<std::uint32_t> stack;  ///< of nodes; empty between queries
};

/// A loose octree over boxes (Ulrich, Loose Octrees, Game Programming Gems, 2000): the division of
/// space that a study puts beside a hierarchy over the boxes themselves.
///
/// A box belongs to one cell: of the size next above its longest side, the one that its middle is
/// in. Cells reach half their size beyond their sides, so that it lies within.
class LooseOctree {
 public:
  /// Empty boxes belong to no cell. The boxes outlive the tree.
  explicit LooseOctree(std::span<const geometry::Box3l> boxes);

  /// Finds the boxes of higher numbers that share a point with a box.
  void find(std::uint32_t item, TreeSearch& search) const;

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Cell {
    geometry::Vec3l lo;
    int log_size = 0;
    std::array<std::uint32_t, 8> child{};  ///< 0: none
    std::uint32_t first_item = kNone;

    [[nodiscard]] geometry::Box3l loose_box() const;
  };

  void insert(std::uint32_t item);
  [[nodiscard]] std::uint32_t child_of(std::uint32_t cell, const geometry::Vec3l& middle);

  std::span<const geometry::Box3l> boxes_;
  std::vector<Cell> cells_;          ///< the root first
  std::vector<std::uint32_t> next_;  ///< per box, the next of its cell
};

}  // namespace strake::cli
