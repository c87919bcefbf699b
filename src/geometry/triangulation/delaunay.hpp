// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangulation/triangulation_mesh.hpp"

namespace strake::geometry::triangulation {

/// Returns the Delaunay triangulation of distinct points in ascending order, as triangles with
/// their neighbours; none when all points are collinear. O(n log n) for any points: by divide and
/// conquer (L. Guibas and J. Stolfi, 1985).
[[nodiscard]] std::vector<TriangulationFace> delaunay(std::span<const Point2> points);

/// Returns the Delaunay triangulation of distinct points in ascending order; no triangles when all
/// are collinear. Points are inserted one by one: fast for the few of most faces, and quadratic
/// where the front is long, as in a comb swept along its teeth.
[[nodiscard]] TriangulationMesh sweep_delaunay(std::vector<Point2> points);

}  // namespace strake::geometry::triangulation
