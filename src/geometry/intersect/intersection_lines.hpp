// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/obb/oriented_box.hpp"
#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {

/// Whether a BVH costs less than it saves; for smaller parts the boxes are sorted instead.
[[nodiscard]] inline bool needs_bvhs(const Part& a, const Part& b) {
  // Between 1024 and 16'384 ships show no difference (decision 0073).
  constexpr std::size_t kMaxSorted = 4096;
  return a.triangles.size() + b.triangles.size() > kMaxSorted;
}

/// Returns the lines along which the surfaces of two parts cross each other, in grid units relative
/// to a's origin, each from its lower end, sorted and without duplicates.
///
/// The set of lines is exact: touching from one side makes none, and where the surfaces overlap
/// only the border of the overlap makes one, where a surface goes on to the other side. Two
/// triangles that cross make none where one lies within `flush` of the other's plane: rounding
/// makes faces that are meant to touch cross anywhere. Ends are the exact ones rounded to the grid,
/// so that a line is off by no more than half a unit along each axis, and collinear segments that
/// share two planes are one line, however the faces are triangulated. Lines that shrink to a point
/// are left out. Both parts need an oriented box, and where needs_bvhs() says so a tree.
[[nodiscard]] std::vector<Segment> part_intersection_lines(const PartWithObb& a,
                                                           const PartWithObb& b, std::int64_t flush,
                                                           QueryContext& work);

/// Returns the same lines, or nothing where more than `limit` pairs of triangles cross: two small
/// surfaces that cross everywhere have as many lines as the product of their triangle counts.
[[nodiscard]] std::optional<std::vector<Segment>> part_intersection_lines_up_to(
    std::size_t limit, const PartWithObb& a, const PartWithObb& b, std::int64_t flush,
    QueryContext& work);

/// Returns the same lines by testing every pair of triangles: the reference. Needs neither oriented
/// boxes nor trees.
[[nodiscard]] std::vector<Segment> part_intersection_lines_brute_force(const PlacedPart& a,
                                                                       const PlacedPart& b,
                                                                       std::int64_t flush,
                                                                       QueryContext& work);

}  // namespace strake::geometry
