// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/intersect/intersection_segments.hpp"
#include "strake/geometry/part.hpp"

// Small displacements of the vertices of a sheet.

namespace strake::geometry {

/// A triangle that is to be displaced to one of its sides.
struct MovingTriangle {
  std::uint32_t triangle = 0;
  bool outward = true;  ///< along its normal, else against it
  bool leads = false;   ///< at its vertices only leading triangles count
};

/// A further direction in which a vertex is to be displaced.
struct VertexDirection {
  std::uint32_t vertex = 0;
  Vec3d way;  ///< unit
};

struct VertexDisplacement {
  std::uint32_t vertex = 0;
  Vec3i by;
};

/// Returns for each vertex of the triangles, ascending, an integer displacement no longer than
/// `limit` grid units (at least 1) that takes it farthest off all the planes that count there, each
/// to its side, and along all its `ways`: the one that maximises the minimum of these. The result
/// does not depend on the numbering of the triangles or the order of their corners.
[[nodiscard]] std::vector<VertexDisplacement> vertex_displacements(
    const Part& part, std::span<const MovingTriangle> triangles,
    std::span<const VertexDirection> ways, double limit);

/// Returns the vertices with which a triangle of an intersection segment, of b or of a, reaches
/// slightly through the other triangle, by a corner or an edge, each with the direction back.
/// Slightly means within `reach` grid units of the other's plane. None where it passes through by
/// more, or lies in that plane.
[[nodiscard]] std::vector<VertexDirection> retraction_directions(const PairLocalPart& a,
                                                                 const PairLocalPart& b,
                                                                 const IntersectionSegment& piece,
                                                                 bool of_b, std::uint32_t triangle,
                                                                 double reach);

}  // namespace strake::geometry
