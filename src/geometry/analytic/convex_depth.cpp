// SPDX-License-Identifier: Apache-2.0
#include "geometry/analytic/convex_depth.hpp"

namespace strake::geometry::analytic {

DepthLook DeepBody::look(const Vec3d& x, double /*r*/) const {
  const InnerField::Nearest near = field_.nearest(x);
  if (!(near.certain > 0)) {
    // Outside the nearest face may not be the one to look at: what parts the two is.
    const ConvexGap gap = convex_gap(point_body(x), body_);
    if (gap.lower > 0) return {0, half_space(body_, gap.normal, 1)};
  }
  return {near.certain, half_space(body_, near.normal, 1)};
}

}  // namespace strake::geometry::analytic
