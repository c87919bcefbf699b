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

/// Whether a tree costs less than what it saves; the boxes of smaller parts are sorted.
[[nodiscard]] inline bool want_trees(const Part& a, const Part& b) {
  constexpr std::size_t kMostSorted = 4096;
  return a.triangles.size() + b.triangles.size() > kMostSorted;
}

/// The lines along which the skins of two parts pass through each other, in grid units relative to
/// a's origin, each from its lower end, ascending and each once.
///
/// Which lines these are is exact: touching from one side makes none, and where the skins lie on
/// each other only the rim along which one goes on to the other side. Where two triangles cross of
/// which one lies within `flush` of the other's plane there is none: faces that are meant to touch
/// cross anywhere, by what rounding made of them. Ends are the exact ones
/// rounded to the grid, so that a line is off by no more than half a unit along each axis, and
/// stretches that share two planes are one line, however the faces are cut into triangles. Lines
/// that shrink to a point are left out. Both parts need a frame, and where want_trees() says so a
/// tree.
[[nodiscard]] std::vector<Segment> part_intersection_lines(const PartWithObb& a,
                                                           const PartWithObb& b, std::int64_t flush,
                                                           QueryContext& work);

/// The same, or nothing where more than `most` pairs of triangles cross: two small skins that cross
/// everywhere have as many lines as the product of their triangles.
[[nodiscard]] std::optional<std::vector<Segment>> part_intersection_lines_up_to(
    std::size_t most, const PartWithObb& a, const PartWithObb& b, std::int64_t flush,
    QueryContext& work);

/// The same by every pair of triangles: the oracle. Neither frame nor tree is asked for.
[[nodiscard]] std::vector<Segment> part_intersection_lines_brute_force(const PlacedPart& a,
                                                                       const PlacedPart& b,
                                                                       std::int64_t flush,
                                                                       QueryContext& work);

}  // namespace strake::geometry
