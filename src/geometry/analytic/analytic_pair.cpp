// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/analytic_pair.hpp"

#include "geometry/analytic/closed_forms.hpp"
#include "geometry/analytic/convex_pair.hpp"
#include "geometry/analytic/torus_pair.hpp"

namespace strake::geometry {

std::optional<AnalyticSeparation> analytic_separation(const PlacedPrimitive& a,
                                                      const PlacedPrimitive& b, double enough) {
  if (auto s = analytic::closed_form(a, b)) return s;
  return solved_separation(a, b, enough);
}

std::optional<AnalyticSeparation> solved_separation(const PlacedPrimitive& a,
                                                    const PlacedPrimitive& b, double enough) {
  if (auto s = analytic::convex_separation(a, b, enough)) return s;
  return analytic::torus_separation(a, b, enough);
}

}  // namespace strake::geometry
