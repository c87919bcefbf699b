// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "strake/geometry/vec.hpp"
#include "strake/parallel/context.hpp"

namespace strake::geometry {

/// From this many vertices on, supports are found by a tree; of fewer, all vertices are visited.
/// Before there were trees a box on a terrain of two million triangles took 7 to 18 ms.
inline constexpr std::size_t kManyVertices = 4096;

/// A tree over points that finds the one farthest in a direction (the support): ranges are split
/// along the longest side of their box. Small sets have no tree and are scanned.
///
///     const SupportTree tree(part.vertices);
///     const double support = tree.support_along(normal).value;
///
/// 1. The value is the greatest n·v in doubles, bit for bit what a scan of all points would give.
/// 2. Building costs n log n; a query on the points of a round or flat body visits some tens of
///    boxes.
class SupportTree {
 public:
  struct SupportPoint {
    double value = 0;  ///< minus infinity for no points
    Vec3i vertex;      ///< one of the points that attain it
  };

  SupportTree() = default;
  /// Builds the same tree for any team.
  explicit SupportTree(std::span<const Vec3i> points, const parallel::Context& context = {});

  [[nodiscard]] bool empty() const { return points_.empty(); }
  [[nodiscard]] SupportPoint support_along(const Vec3d& n) const;

  /// Returns at most `limit` of the points in a box, in an order that depends on the points alone.
  [[nodiscard]] std::vector<Vec3i> points_within(const Box3d& box, std::size_t limit) const;

  /// Whether n·v <= level for all points; also false where that takes visits to more than `boxes`
  /// boxes. Subtracts the boxes visited.
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
