// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/obb/oriented_box.hpp"
#include "strake/geometry/part_pair.hpp"

// The segments in which the surfaces of two parts cross.

namespace strake::geometry {

/// A segment common to two triangles, one of each part. It lies on the line of an edge (0..2) of
/// either where that number is not negative.
struct IntersectionSegment {
  std::uint32_t a = 0, b = 0;
  int edge_a = -1, edge_b = -1;
};

struct IntersectionSegments {
  std::vector<IntersectionSegment> all;
  bool truncated = false;  ///< the list may be incomplete
};

/// Returns the segments along which the surface of one part passes from one side of the other's to
/// the other side. Where the surfaces overlap, they cross if a leaves the border of the common area
/// to one side of b somewhere and to the other elsewhere; the segments then are those of the border
/// where it does so. Touching from one side is no crossing, nor is a sheet that ends on the other.
///
/// Exact. Stops after `limit` segments that cross outright, or after one of them for which
/// `is_last` holds. The cost is that of the contacts.
[[nodiscard]] IntersectionSegments find_intersection_segments(
    const PartWithBvh& a, const PartWithBvh& b, std::size_t limit, QueryContext& work,
    const std::function<bool(const IntersectionSegment&)>& is_last = {});

/// Returns the same segments in any order; cheap also for parts rotated against the coordinate
/// axes. Both need an oriented box, and where needs_bvhs() says so a tree.
[[nodiscard]] IntersectionSegments find_intersection_segments(const PartWithObb& a,
                                                              const PartWithObb& b,
                                                              std::size_t limit,
                                                              QueryContext& work);

/// Returns the same segments by testing every pair of triangles.
[[nodiscard]] std::vector<IntersectionSegment> find_intersection_segments_brute_force(
    const PlacedPart& a, const PlacedPart& b, QueryContext& work);

using DoubleSegment = std::array<Vec3d, 2>;

/// Returns the rounded ends of an intersection segment: grid units in the coordinates of the views.
/// None where it is too short for doubles.
[[nodiscard]] std::optional<DoubleSegment> segment_geometry(const PairLocalPart& a,
                                                            const PairLocalPart& b,
                                                            const IntersectionSegment& piece);

}  // namespace strake::geometry
