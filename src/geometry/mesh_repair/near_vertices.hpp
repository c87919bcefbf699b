// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A length in grid units up to which corners count as one; at most this.
inline constexpr std::int64_t kMostWeld = std::int64_t{1} << 20U;

/// The squared distance of two points on the grid, exact.
[[nodiscard]] __int128 squared_distance(const Vec3i& p, const Vec3i& q);

/// Whether a point lies no farther from a segment than `within` (up to kMostWeld): exact.
[[nodiscard]] bool is_near_segment(const Vec3i& p, const Vec3i& a, const Vec3i& b,
                                   std::int64_t within);

/// Some of the vertices of a mesh, for "which of them are near this segment?": a tree of boxes,
/// halved along their longest sides (J. L. Bentley, 1975). The answer is exact, whatever the tree.
class NearPoints {
 public:
  NearPoints(std::span<const Vec3i> vertices, std::vector<std::uint32_t> some);

  /// Appends those no farther from the segment a-b than `within`, in no particular order. The two
  /// ends may be one. False where that takes a look at more than `boxes` boxes; takes off those
  /// that it looked at, which hang on differences of coordinates alone.
  [[nodiscard]] bool near(const Vec3i& a, const Vec3i& b, std::int64_t within, std::uint64_t& boxes,
                          std::vector<std::uint32_t>& found) const;

  /// Boxes enough for this many segments, some of which run along all points: soup of long edges
  /// that cross each other everywhere takes more.
  [[nodiscard]] static constexpr std::uint64_t boxes_for(std::size_t segments) {
    constexpr std::uint64_t kEach = 64, kAlways = std::uint64_t{1} << 22U;
    return kAlways + kEach * segments;
  }

 private:
  struct Node {
    Box3i box;
    std::uint32_t first = 0, count = 0;  ///< of points_
    std::uint32_t left = 0;              ///< child, the right one behind it; 0: a leaf
  };

  void split(std::size_t node);

  std::span<const Vec3i> vertices_;
  std::vector<std::uint32_t> points_;  ///< leaf by leaf
  std::vector<Node> nodes_;
};

/// Corners that count as one, and where: the corner nearest to the middle of their box.
struct VertexCluster {
  std::uint32_t at = 0;
  std::vector<std::uint32_t> members;  ///< ascending, `at` among them
};

/// Of some vertices, those that hang together with each no farther than `within` from the next, as
/// far as none is farther than that from where they are to be. `some` ascending, and the points of
/// `points`. Nothing where very many are near each other, more than corners of solids can be.
[[nodiscard]] std::vector<VertexCluster> cluster_near_vertices(std::span<const Vec3i> vertices,
                                                               std::span<const std::uint32_t> some,
                                                               const NearPoints& points,
                                                               std::int64_t within);

}  // namespace strake::geometry
