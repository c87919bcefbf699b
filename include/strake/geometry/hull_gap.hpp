// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/part_frame.hpp"

namespace strake::geometry {

/// The distance of the hulls of two parts that have vertices, by Gilbert, Johnson and Keerthi
/// (1988). Ends at a lower bound of `enough` grid units; where it is not positive nothing is known.
/// Costs some ten looks at the vertices of either.
[[nodiscard]] PartingGap hull_gap(const FramedPart& a, const FramedPart& b, double enough);

}  // namespace strake::geometry
