// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/corners.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// What rounding may cut off where triangles are cut, grid units: boxes of what is common reach
/// that much farther.
inline constexpr double kCutMargin = 1;

/// Adds what of two triangles lies within reach of the other to a box: at most what the boxes of
/// the two, each wider by reach and margin, have in common.
void include_common(const TriangleCorners& a, const TriangleCorners& b, double reach,
                    Box3d& extent);

}  // namespace strake::geometry
