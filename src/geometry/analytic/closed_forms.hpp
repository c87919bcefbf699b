// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "strake/geometry/analytic_pair.hpp"

namespace strake::geometry::analytic {

/// A sphere and a sphere, cylinder or box, and cylinders with parallel axes, under placements that
/// leave the kind as it is; nothing for any other pair. What the rounding of a source's matrices
/// makes of right angles and parallel axes is part of the error.
[[nodiscard]] std::optional<AnalyticSeparation> closed_form(const PlacedPrimitive& a,
                                                            const PlacedPrimitive& b);

}  // namespace strake::geometry::analytic
