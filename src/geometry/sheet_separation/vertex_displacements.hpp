// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/intersect/intersection_segments.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// A triangle that is to move to one of its sides.
struct MovingTriangle {
  std::uint32_t triangle = 0;
  bool outward = true;  ///< along its normal, seen from where it runs counter-clockwise
  bool leads = false;   ///< at its corners only triangles that lead have a say
};

/// Where else a corner is to move.
struct VertexDirection {
  std::uint32_t vertex = 0;
  Vec3d way;  ///< unit
};

struct VertexDisplacement {
  std::uint32_t vertex = 0;
  Vec3i by;
};

/// For each corner of the triangles, ascending: of the whole moves no longer than `most` grid units
/// (at least 1) one that takes it farthest off all the planes that have a say there, each to its
/// side, and along all its `ways`, of corners of the triangles: that which makes the least of these
/// the greatest. The same however the triangles are numbered and their corners ordered.
[[nodiscard]] std::vector<VertexDisplacement> vertex_displacements(
    const Part& part, std::span<const MovingTriangle> triangles,
    std::span<const VertexDirection> ways, double most);

/// Where a triangle that holds a crossing piece, of b or of a, reaches through the other triangle
/// with a corner or an edge by little: those corners, each with the way back. Little is what lies
/// within `reach` grid units off the plane of the other. None where it passes through by more, or
/// lies in that plane.
[[nodiscard]] std::vector<VertexDirection> retraction_directions(const PairLocalPart& a,
                                                                 const PairLocalPart& b,
                                                                 const IntersectionSegment& piece,
                                                                 bool of_b, std::uint32_t triangle,
                                                                 double reach);

}  // namespace strake::geometry
