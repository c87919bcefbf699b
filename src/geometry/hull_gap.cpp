// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/hull_gap.hpp"

#include "geometry/analytic/convex_gap.hpp"
#include "geometry/hull_body.hpp"

namespace strake::geometry {

PartingGap hull_gap(const FramedPart& a, const FramedPart& b, double enough) {
  const Vec3l shift = b.placed.origin - a.placed.origin;
  const analytic::ConvexGap gap = analytic::convex_gap(
      hull_body(*a.placed.part, a.frame->vertices, {}),
      hull_body(*b.placed.part, b.frame->vertices, shift.as<double>()), enough);
  return {gap.lower, gap.normal};
}

}  // namespace strake::geometry
