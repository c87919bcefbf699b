// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/hull_gap.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/analytic/convex_gap.hpp"

namespace strake::geometry {
namespace {

analytic::ConvexBody hull_of(const FramedPart& framed, const Vec3d& origin) {
  const Part& part = *framed.placed.part;
  const Box3d box = part.box.as<double>().moved(origin);
  analytic::ConvexBody body{.shape = analytic::Hull{part.vertices, &framed.frame->vertices, origin},
                            .middle = (box.lo + box.hi) * 0.5};
  for (int k = 0; k < 3; ++k)
    body.reach = std::max({body.reach, std::fabs(box.lo[k]), std::fabs(box.hi[k])});
  body.error = analytic::kSupportRounding * body.reach;
  return body;
}

}  // namespace

HullGap hull_gap(const FramedPart& a, const FramedPart& b, double enough) {
  const Vec3l shift = b.placed.origin - a.placed.origin;
  const analytic::ConvexGap gap =
      analytic::convex_gap(hull_of(a, {}), hull_of(b, shift.as<double>()), enough);
  return {gap.lower, gap.normal};
}

}  // namespace strake::geometry
