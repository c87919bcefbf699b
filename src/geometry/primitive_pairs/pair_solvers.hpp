// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "strake/geometry/primitive_separation.hpp"

namespace strake::geometry::primitive_pairs {

/// Returns the separation of a sphere and a sphere, cylinder or box, and of cylinders with parallel
/// axes, under placements that preserve the kind; nothing for any other pair. Right angles and
/// parallel axes that the source's matrices have rounded are part of the error.
[[nodiscard]] std::optional<PrimitiveSeparation> closed_form(const PlacedPrimitive& a,
                                                             const PlacedPrimitive& b);

/// Returns the separation of two convex primitives under any placements; nothing for others, and
/// for two without thickness that meet.
[[nodiscard]] std::optional<PrimitiveSeparation> convex_separation(const PlacedPrimitive& a,
                                                                   const PlacedPrimitive& b,
                                                                   double cutoff);

/// Returns the separation of two primitives, at least one of them a torus; nothing for what
/// Torus::of() and convex_body() leave out, and for bodies without thickness that meet the other.
[[nodiscard]] std::optional<PrimitiveSeparation> torus_separation(const PlacedPrimitive& a,
                                                                  const PlacedPrimitive& b,
                                                                  double cutoff);

}  // namespace strake::geometry::primitive_pairs
