// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/primitive_separation.hpp"

#include "geometry/primitive_pairs/pair_solvers.hpp"

namespace strake::geometry {

std::optional<PrimitiveSeparation> primitive_separation(const PlacedPrimitive& a,
                                                        const PlacedPrimitive& b, double cutoff) {
  if (auto s = primitive_pairs::closed_form(a, b)) return s;
  return iterative_separation(a, b, cutoff);
}

std::optional<PrimitiveSeparation> iterative_separation(const PlacedPrimitive& a,
                                                        const PlacedPrimitive& b, double cutoff) {
  if (auto s = primitive_pairs::convex_separation(a, b, cutoff)) return s;
  return primitive_pairs::torus_separation(a, b, cutoff);
}

}  // namespace strake::geometry
