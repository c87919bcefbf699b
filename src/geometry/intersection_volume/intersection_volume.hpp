// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {

/// The volume of the intersection of two solids, cubic grid units.
struct IntersectionVolume {
  double volume = 0;
  double lower = 0, upper = 0;  ///< certain: the arithmetic is off by no more than this
  std::uint64_t triangle_pairs = 0;
};

/// Returns the volume of the intersection of two solids as they are on the grid: a body with a
/// primitive counts as its tessellation. Nothing when this would take more than `max_work` pairs
/// of triangles or nodes, and for parts that are no solids.
///
///     const auto common = intersection_volume(pipe, wall, 1000000);
///     if (common) use(common->volume);
///
/// Along a coordinate axis w a solid is a sum over its triangles, +1 below those that face up, -1
/// below those that face down. So the volume is the sum over pairs of triangles of ±∫ max(min(w_a,
/// w_b), bottom) - bottom over the common part of their projections: a convex polygon cut where the
/// two planes meet. Triangles parallel to the axis drop out, and with them every degenerate case:
/// coplanar faces, shared edges, copies and bodies inside bodies are sums like any other.
///
/// 1. The bracket is certain: rounding is bounded term by term.
/// 2. The result depends on the two parts and their relative position only; the same bits anywhere.
/// 3. Swapped or rotated parts may give other bits (the brackets then overlap). The result holds
///    for parts as repair_mesh() makes them, with winding numbers 0 or 1; what a self-intersecting
///    mesh covers twice counts twice.
[[nodiscard]] std::optional<IntersectionVolume> intersection_volume(const PartWithBvh& a,
                                                                    const PartWithBvh& b,
                                                                    std::uint64_t max_work);

}  // namespace strake::geometry
