// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "strake/geometry/mesh.hpp"
#include "strake/geometry/plane_cut.hpp"

namespace strake::geometry::section {

/// From one vertex to another.
using Directed = std::array<std::uint32_t, 2>;

/// Appends to `triangles` what the oriented outline surrounds with a winding number that is not
/// zero, and to `vertices` those that had to be made where lines cross. False, and nothing
/// appended, where the outline is not closed or too crooked to be triangulated on the grid.
[[nodiscard]] bool fill(const CutPlane& plane, std::span<const Directed> outline,
                        std::vector<Vec3l>& vertices, std::vector<Triangle>& triangles);

}  // namespace strake::geometry::section
