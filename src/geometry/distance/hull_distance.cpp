// SPDX-License-Identifier: Apache-2.0
#include "geometry/distance/hull_distance.hpp"

#include "geometry/primitive_pairs/solvers/gjk.hpp"

namespace strake::geometry {

SeparationBound convex_hull_separation(const PartWithObb& a, const PartWithObb& b, double cutoff) {
  const Vec3l shift = b.placed.origin - a.placed.origin;
  const primitive_pairs::GjkResult gap = primitive_pairs::gjk_distance(
      convex_hull_body(*a.placed.part, a.frame->vertices, {}),
      convex_hull_body(*b.placed.part, b.frame->vertices, shift.as<double>()), cutoff);
  return {gap.lower, gap.normal};
}

}  // namespace strake::geometry
