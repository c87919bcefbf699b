// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/polygon/cells.hpp"

namespace strake::geometry::polygon {

/// The Delaunay triangulation of distinct points in ascending order, as cells that know their
/// neighbours; none when all points are collinear. O(n log n) whatever the points: by halves
/// (L. Guibas and J. Stolfi, 1985).
[[nodiscard]] std::vector<Cell> delaunay(std::span<const Point2> points);

}  // namespace strake::geometry::polygon
