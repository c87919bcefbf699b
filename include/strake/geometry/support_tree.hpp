// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "strake/geometry/vec.hpp"
#include "strake/parallel/context.hpp"

namespace strake::geometry {

/// From as many vertices on their tree is asked where fewer would all be looked at.
inline constexpr std::size_t kManyVertices = 4096;

/// A set of points for "which is farthest this way?": halved again and again along the longest
/// side of its box. Small sets are only walked.
///
///     const SupportTree tree(part.vertices);
///     const double support = tree.support_along(normal).value;
///
/// 1. The value is the greatest n·v as doubles give it, to the bit what a walk over all would give.
/// 2. Building costs n log n; a question about points on a round or flat body some tens of boxes.
class SupportTree {
 public:
  struct SupportPoint {
    double value = 0;  ///< minus infinity for no points
    Vec3i vertex;      ///< one of those that have it
  };

  SupportTree() = default;
  /// The same tree with any team or none.
  explicit SupportTree(std::span<const Vec3i> points, const parallel::Context& context = {});

  [[nodiscard]] bool empty() const { return points_.empty(); }
  [[nodiscard]] SupportPoint support_along(const Vec3d& n) const;

  /// The points in a box, up to a number, in an order that depends on the points alone.
  [[nodiscard]] std::vector<Vec3i> points_within(const Box3d& box, std::size_t most) const;

  /// Whether n·v <= level for all points. False too where that takes a look at more than `boxes`
  /// boxes; takes off those that it looked at.
  [[nodiscard]] bool all_at_or_below(const Vec3d& n, double level, std::uint64_t& boxes) const;

 private:
  struct Node {
    Box3i box;
    std::uint32_t first = 0;  ///< inner: index of the left child (right = left + 1); leaf: point
    std::uint32_t count = 0;  ///< 0: inner node; otherwise points in the leaf
  };

  std::vector<Vec3i> points_;  ///< leaf by leaf
  std::vector<Node> nodes_;    ///< empty for few points
};

}  // namespace strake::geometry
