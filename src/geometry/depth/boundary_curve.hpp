// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// The edges of a sheet at which it ends: those whose triangles do not cancel in direction, but for
/// those between two triangles of which one goes on where the other ends, wound to and fro.
/// Grid units, in the part's own coordinates.
[[nodiscard]] std::vector<std::array<Vec3d, 2>> boundary_curve(const Part& part);

}  // namespace strake::geometry
