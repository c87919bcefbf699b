// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0053 says why such facets hide nothing of their own part.

#include <cstdint>

#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::hlr {

/// Returns whether a triangle of a part may be seen edge-on along a direction, were its corners not
/// rounded to the grid, each coordinate by half a unit at most. Exact. False for triangles so
/// narrow that rounding may have turned them anyhow.
///
/// With corners p, q, r and the direction d the product (q - p) × (r - p) · d, which is zero
/// edge-on, is changed by half the taxicab lengths of d × (q - r), d × (r - p) and d × (p - q), and
/// by one and a half times the taxicab length of d where two corners move.
[[nodiscard]] bool may_be_edge_on(const geometry::Part& part, std::uint32_t triangle,
                                  const geometry::Vec3l& direction);

}  // namespace strake::hlr
