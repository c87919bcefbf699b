// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geometry/polygon/cells.hpp"

namespace strake::geometry::polygon {

/// The Delaunay triangulation of distinct points in ascending order; no triangles when all are
/// collinear. Point by point: quick for the few of most faces, and quadratic where the front is
/// long, as in a comb that is swept along its teeth.
[[nodiscard]] Cells swept(std::vector<Point2> points);

}  // namespace strake::geometry::polygon
