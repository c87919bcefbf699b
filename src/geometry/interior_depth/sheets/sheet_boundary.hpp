// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// Returns the boundary edges of a sheet: those whose triangles do not cancel in direction, except
/// between two triangles that continue each other with opposite orientation. Grid units, in the
/// part's own coordinates.
[[nodiscard]] std::vector<std::array<Vec3d, 2>> boundary_edges(const Part& part);

/// A tree over segments for the distance to the nearest: long segments are split relative to the
/// space that each has, and ranges along the longest side of their box, so that a query costs the
/// logarithm of their number.
class SegmentBvh {
 public:
  using Segment = std::array<Vec3d, 2>;

  struct NearestSegment {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t segment = 0;  ///< any of those equally near
  };

  explicit SegmentBvh(std::vector<Segment> segments);

  [[nodiscard]] bool empty() const { return segments_.empty(); }
  [[nodiscard]] const Segment& operator[](std::uint32_t i) const { return segments_[i]; }

  /// The segment nearest to a point, if nearer than `limit`; the distance is bit for bit what a
  /// scan of all would give. The first that is no farther than `cutoff` suffices.
  [[nodiscard]] NearestSegment nearest(const Vec3d& p, double limit, double cutoff) const;

 private:
  struct Node {
    Box3d box = empty_box<double>();
    std::uint32_t first = 0;  ///< inner: left child (right = first + 1); leaf: first of order_
    std::uint32_t count = 0;  ///< 0: inner node; otherwise pieces in the leaf
  };
  /// A piece of a segment; long segments have several.
  struct SegmentPiece {
    Box3d box;
    std::uint32_t segment = 0;
    std::uint32_t number = 0;  ///< among all pieces
  };

  [[nodiscard]] std::vector<SegmentPiece> cut() const;
  void build(std::uint32_t node, std::span<SegmentPiece> pieces);

  std::vector<Segment> segments_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;  ///< segments by piece, leaf by leaf
};

}  // namespace strake::geometry
