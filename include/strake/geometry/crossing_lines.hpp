// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {

/// The lines along which the skins of two parts pass through each other, in grid units relative to
/// a's origin, each from its lower end, ascending and each once.
///
/// Which lines these are is exact: touching from one side makes none, and where the skins lie on
/// each other only the rim along which one goes on to the other side. Where two triangles cross of
/// which one lies within `flush` of the other's plane there is none: faces that are meant to touch
/// cross anywhere, by what rounding made of them. Ends are the exact ones
/// rounded to the grid, so that a line is off by no more than half a unit along each axis, and
/// stretches that share two planes are one line, however the faces are cut into triangles. Lines
/// that shrink to a point are left out. Both parts need trees.
[[nodiscard]] std::vector<Segment> crossing_lines(const TreedPart& a, const TreedPart& b,
                                                  std::int64_t flush, PairWork& work);

}  // namespace strake::geometry
