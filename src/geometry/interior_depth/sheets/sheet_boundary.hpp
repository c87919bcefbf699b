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

/// The edges of a sheet at which it ends: those whose triangles do not cancel in direction, but for
/// those between two triangles of which one goes on where the other ends, wound to and fro.
/// Grid units, in the part's own coordinates.
[[nodiscard]] std::vector<std::array<Vec3d, 2>> boundary_edges(const Part& part);

/// Segments for "how far is the nearest of them": cut where they are long against the room that
/// each has, and halved again and again along the longest side of their box, so that a question
/// costs the logarithm of their number.
class SegmentBvh {
 public:
  using Segment = std::array<Vec3d, 2>;

  struct NearestSegment {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t segment = 0;  ///< of several as near, any
  };

  explicit SegmentBvh(std::vector<Segment> segments);

  [[nodiscard]] bool empty() const { return segments_.empty(); }
  [[nodiscard]] const Segment& operator[](std::uint32_t i) const { return segments_[i]; }

  /// The segment nearest to a point, if nearer than `limit`; the distance is to the bit what a look
  /// at all of them would give. The first that is no farther than `enough` will do.
  [[nodiscard]] NearestSegment nearest(const Vec3d& p, double limit, double enough) const;

 private:
  struct Node {
    Box3d box = empty_box<double>();
    std::uint32_t first = 0;  ///< inner: left child (right = first + 1); leaf: first of order_
    std::uint32_t count = 0;  ///< 0: inner node; otherwise pieces in the leaf
  };
  /// Of a segment, that has more if it is long.
  struct SegmentPiece {
    Box3d box;
    std::uint32_t segment = 0;
  };

  [[nodiscard]] std::vector<SegmentPiece> cut() const;
  void build(std::uint32_t node, std::span<SegmentPiece> pieces);

  std::vector<Segment> segments_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;  ///< segments by piece, leaf by leaf
};

}  // namespace strake::geometry
