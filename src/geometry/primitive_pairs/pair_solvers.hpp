// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "strake/geometry/primitive_separation.hpp"

namespace strake::geometry::primitive_pairs {

/// A sphere and a sphere, cylinder or box, and cylinders with parallel axes, under placements that
/// leave the kind as it is; nothing for any other pair. What the rounding of a source's matrices
/// makes of right angles and parallel axes is part of the error.
[[nodiscard]] std::optional<PrimitiveSeparation> closed_form(const PlacedPrimitive& a,
                                                             const PlacedPrimitive& b);

/// Two convex primitives under any placements; nothing for others, and for two without thickness
/// that meet.
[[nodiscard]] std::optional<PrimitiveSeparation> convex_separation(const PlacedPrimitive& a,
                                                                   const PlacedPrimitive& b,
                                                                   double enough);

/// Two primitives of which at least one is a torus; nothing for what Torus::of and convex_body
/// leave out, and for bodies without thickness that meet the other.
[[nodiscard]] std::optional<PrimitiveSeparation> torus_separation(const PlacedPrimitive& a,
                                                                  const PlacedPrimitive& b,
                                                                  double enough);

}  // namespace strake::geometry::primitive_pairs
