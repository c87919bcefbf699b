// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/geometry/part.hpp"
#include "strake/parallel/context.hpp"

namespace strake::geometry {

/// A bounding-volume hierarchy over the triangles of one part, in the part's own coordinates, so
/// that all bodies of the part share it.
class TriangleBvh {
 public:
  /// Maximum number of triangles in a leaf.
  static constexpr std::uint32_t kLeafSize = 4;

  struct Node {
    Box3i box;
    std::uint32_t first = 0;  ///< inner: left child (right = left + 1); leaf: first of order()
    std::uint32_t count = 0;  ///< 0: inner node; otherwise triangles in the leaf
  };

  TriangleBvh() = default;
  /// Builds the same tree for any team; it has no nodes where the context's stop token ended the
  /// work.
  explicit TriangleBvh(const Part& part, const parallel::Context& context = {});
  /// Builds a tree over some triangles of a part.
  TriangleBvh(const Part& part, std::span<const std::uint32_t> triangles);

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }  ///< root first
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  template <class Pick>
  void build(const Part& part, std::uint32_t n, const Pick& pick, const parallel::Context& context);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace strake::geometry
