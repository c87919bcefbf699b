// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "strake/drawing/drawing.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::drawing {

/// Lines further apart than this on paper are two lines, mm.
inline constexpr double kDuplicateDistance = 0.002;

/// Splits lines where they lie on other lines of the paper and marks what is covered as duplicate.
///
/// Of two lines that coincide over a stretch, the visible one stays, then the nearer to the
/// viewer, then that of the lowest object and edge. Lines that are drawn nowhere (projecting,
/// clipped) take no part. The order of lines stays; the parts of a split line follow each other
/// from a to b.
///
/// Cost: lines that share a cell of a grid over the sheet are compared with each other.
[[nodiscard]] std::vector<Line> mark_duplicates(std::vector<Line> lines,
                                                const geometry::Vec3d& toward);

}  // namespace strake::drawing
