// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "strake/geometry/analytic_pair.hpp"

namespace strake::geometry::analytic {

/// Two convex primitives under any placements; nothing for others, and for two without thickness
/// that meet.
[[nodiscard]] std::optional<AnalyticSeparation> convex_separation(const PlacedPrimitive& a,
                                                                  const PlacedPrimitive& b,
                                                                  double enough);

}  // namespace strake::geometry::analytic
