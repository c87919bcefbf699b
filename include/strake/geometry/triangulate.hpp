// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "strake/geometry/mesh.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

enum class FaceFault : std::uint8_t {
  none,
  not_finite,  ///< a coordinate is not a finite number
  no_area,     ///< the first contour encloses nothing
  crossing,    ///< contours cross themselves or each other: new vertices would be needed
};

/// Returns the text for a diagnostic: "contours cross".
[[nodiscard]] std::string_view describe(FaceFault fault);

struct FaceTriangles {
  std::vector<Triangle> triangles;  ///< indices into the points given; empty on a fault
  FaceFault fault = FaceFault::none;
};

/// Triangulates a planar, or nearly planar, face with holes over its vertices.
///
///     const std::vector<std::uint32_t> first{0, 4, 8};  // a square and a square hole
///     const FaceTriangles t = triangulate_face(points, first);
///
/// Contour i is points[first[i] .. first[i + 1]), closed without repeating its first point. The
/// interior is what an odd number of contours surround, so the orientation of holes does not
/// matter; the triangles have the orientation of the first contour.
///
/// 1. Every edge of a contour is an edge of the triangles, split where other vertices lie on it:
///    neighbouring faces that share an edge stay joined. No vertex is added, and none with an edge
///    is lost, collinear ones included.
/// 2. Repeated points, repeated and opposite edges, contours that touch themselves or each other
///    are fine. Contours that cross are a fault.
/// 3. Decisions are exact, on the points moved to the centre of their box, scaled to 29 bits and
///    projected along the largest component of the first contour's normal.
/// 4. The result does not depend on where a contour starts, but for the choice among diagonals of
///    cocircular points.
///
/// The result is a constrained Delaunay triangulation: of few points by sweep insertion with
/// Lawson's flips (C. L. Lawson, 1977), of many by divide and conquer (L. Guibas and J. Stolfi,
/// 1985); where an edge is missing, the triangles that it crosses are replaced on both sides (M. V.
/// Anglada, 1997). The cost is O(n log n) for combs, stars and grids of holes, and O(n^2) for
/// slanted teeth, every edge of which crosses many.
[[nodiscard]] FaceTriangles triangulate_face(std::span<const Vec3d> points,
                                             std::span<const std::uint32_t> first);

/// Triangulates a face of one contour.
[[nodiscard]] FaceTriangles triangulate_face(std::span<const Vec3d> contour);

}  // namespace strake::geometry
