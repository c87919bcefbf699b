// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geometry/corners.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// Where a segment comes nearest to a triangle, from 0 at its start to 1 at its end, if it comes
/// within reach of it (the square is given). In double arithmetic, off by some roundings of the
/// coordinates.
[[nodiscard]] std::optional<double> near_along(const Vec3d& from, const Vec3d& to, const Corners& t,
                                               double squared_reach);

}  // namespace strake::geometry
