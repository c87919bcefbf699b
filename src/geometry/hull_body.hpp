// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/analytic/support_shape.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// The convex hull of a part whose coordinates are relative to `origin`. `tree`: over its vertices,
/// or empty.
[[nodiscard]] inline analytic::ConvexBody hull_body(const Part& part, const VertexTree& tree,
                                                    const Vec3d& origin) {
  const Box3d box = part.box.as<double>().moved(origin);
  analytic::ConvexBody body{.shape = analytic::Hull{part.vertices, &tree, origin},
                            .middle = (box.lo + box.hi) * 0.5};
  for (int k = 0; k < 3; ++k)
    body.reach = std::max({body.reach, std::fabs(box.lo[k]), std::fabs(box.hi[k])});
  body.error = analytic::kSupportRounding * body.reach;
  return body;
}

}  // namespace strake::geometry
