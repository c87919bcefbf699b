// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangulation/triangulation_mesh.hpp"

namespace strake::geometry::triangulation {

/// The Delaunay triangulation of distinct points in ascending order, as cells that know their
/// neighbours; none when all points are collinear. O(n log n) whatever the points: by halves
/// (L. Guibas and J. Stolfi, 1985).
[[nodiscard]] std::vector<TriangulationFace> delaunay(std::span<const Point2> points);

}  // namespace strake::geometry::triangulation

namespace strake::geometry::triangulation {

/// The Delaunay triangulation of distinct points in ascending order; no triangles when all are
/// collinear. Point by point: quick for the few of most faces, and quadratic where the front is
/// long, as in a comb that is swept along its teeth.
[[nodiscard]] TriangulationMesh sweep_delaunay(std::vector<Point2> points);

}  // namespace strake::geometry::triangulation
