// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "strake/geometry/vec.hpp"

// Search for vertices near a segment, and clusters of vertices within a tolerance.

namespace strake::geometry {

/// The greatest length, in grid units, up to which vertices may be merged.
inline constexpr std::int64_t kMaxWeld = std::int64_t{1} << 20U;

/// Returns the exact squared distance of two points on the grid.
[[nodiscard]] __int128 squared_distance(const Vec3i& p, const Vec3i& q);

/// Whether a point lies no farther from a segment than `within` (up to kMaxWeld): exact.
[[nodiscard]] bool is_near_segment(const Vec3i& p, const Vec3i& a, const Vec3i& b,
                                   std::int64_t within);

/// A k-d tree over some of the vertices of a mesh, for those near a segment: boxes are halved along
/// their longest sides (J. L. Bentley, 1975). The result is exact and does not depend on the tree.
class NearPoints {
 public:
  NearPoints(std::span<const Vec3i> vertices, std::vector<std::uint32_t> some);

  /// Appends the vertices no farther from the segment a-b than `within`, in no particular order.
  /// The two ends may be equal. False where that takes visits to more than `boxes` boxes; subtracts
  /// the boxes visited, which depend on differences of coordinates alone.
  [[nodiscard]] bool near(const Vec3i& a, const Vec3i& b, std::int64_t within, std::uint64_t& boxes,
                          std::vector<std::uint32_t>& found) const;

  /// Returns a number of boxes sufficient for this many segments, some of which run along all
  /// points: a soup of long edges that cross each other everywhere takes more.
  [[nodiscard]] static constexpr std::uint64_t boxes_for(std::size_t segments) {
    // Four times what points of one place each take. Where 100,000 large triangles all cross each
    // other the search ends here: the stage takes 4 s, and 0.3 without the search (decision 0034).
    constexpr std::uint64_t kEach = 64, kAlways = std::uint64_t{1} << 22U;
    return kAlways + kEach * segments;
  }

 private:
  struct Node {
    Box3i box;
    std::uint32_t first = 0, count = 0;  ///< of points_
    std::uint32_t left = 0;              ///< left child, the right one follows it; 0: a leaf
  };

  void split(std::size_t node);

  std::span<const Vec3i> vertices_;
  std::vector<std::uint32_t> points_;  ///< leaf by leaf
  std::vector<Node> nodes_;
};

/// Vertices that are merged, and their common position: the vertex nearest to the middle of their
/// box.
struct VertexCluster {
  std::uint32_t at = 0;
  std::vector<std::uint32_t> members;  ///< ascending, `at` among them
};

/// Returns the clusters of some vertices connected by distances of at most `within`, except those
/// with a vertex farther than that from their common position. `some` is ascending and holds the
/// points of `points`. Nothing where more are near each other than vertices of solids can be.
[[nodiscard]] std::vector<VertexCluster> cluster_near_vertices(std::span<const Vec3i> vertices,
                                                               std::span<const std::uint32_t> some,
                                                               const NearPoints& points,
                                                               std::int64_t within);

}  // namespace strake::geometry
