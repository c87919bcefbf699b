// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "strake/geometry/analytic_pair.hpp"

namespace strake::geometry::analytic {

/// Two primitives of which at least one is a torus; nothing for what Torus::of and convex_body
/// leave out, and for bodies without thickness that meet the other.
[[nodiscard]] std::optional<AnalyticSeparation> torus_separation(const PlacedPrimitive& a,
                                                                 const PlacedPrimitive& b,
                                                                 double enough);

}  // namespace strake::geometry::analytic
