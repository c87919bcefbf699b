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

namespace strake::geometry {

/// A stretch that two triangles have in common, one of each part: in the line of an edge (0..2)
/// of either where that is not negative.
struct IntersectionSegment {
  std::uint32_t a = 0, b = 0;
  int edge_a = -1, edge_b = -1;
};

struct IntersectionSegments {
  std::vector<IntersectionSegment> all;
  bool truncated = false;  ///< there may be more
};

/// The stretches along which the skin of one part passes from one side of the other's to the other
/// side. Where they lie on each other, they cross if somewhere along the rim of that common area a
/// goes on to one side of b and elsewhere to the other; the stretches then are those of the rim
/// where it does so. Touching from one side is no crossing, nor is a sheet that ends on the other.
///
/// Exact. Stops after `most` stretches that cross outright, or after one of them that is `enough`.
/// The cost is that of the contacts.
[[nodiscard]] IntersectionSegments find_intersection_segments(
    const PartWithBvh& a, const PartWithBvh& b, std::size_t most, QueryContext& work,
    const std::function<bool(const IntersectionSegment&)>& enough = {});

/// The same, in any order; cheap also for parts that stand askew to the coordinate axes. Both
/// want a frame, and where want_trees() says so a tree.
[[nodiscard]] IntersectionSegments find_intersection_segments(const PartWithObb& a,
                                                              const PartWithObb& b,
                                                              std::size_t most, QueryContext& work);

/// The same by every pair of triangles.
[[nodiscard]] std::vector<IntersectionSegment> find_intersection_segments_brute_force(
    const PlacedPart& a, const PlacedPart& b, QueryContext& work);

using DoubleSegment = std::array<Vec3d, 2>;

/// Where a crossing piece lies, rounded: grid units in the coordinates of the views. None where it
/// is too short to tell.
[[nodiscard]] std::optional<DoubleSegment> segment_geometry(const PairLocalPart& a,
                                                            const PairLocalPart& b,
                                                            const IntersectionSegment& piece);

}  // namespace strake::geometry
