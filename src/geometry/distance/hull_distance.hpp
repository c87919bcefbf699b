// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0022 says why the hulls come before any traversal.

#include <algorithm>
#include <cmath>

#include "geometry/obb/oriented_box.hpp"
#include "geometry/primitive_pairs/shapes/support_mapping.hpp"
#include "strake/geometry/part.hpp"

// The distance of the convex hulls of two parts.

namespace strake::geometry {

/// Returns the convex hull of a part whose coordinates are relative to `origin`. `tree`: over its
/// vertices, or empty.
[[nodiscard]] inline primitive_pairs::ConvexBody convex_hull_body(const Part& part,
                                                                  const SupportTree& tree,
                                                                  const Vec3d& origin) {
  const Box3d box = part.box.as<double>().moved(origin);
  primitive_pairs::ConvexBody body{
      .shape = primitive_pairs::VertexHull{part.vertices, &tree, origin},
      .middle = (box.lo + box.hi) * 0.5};
  for (int k = 0; k < 3; ++k)
    body.reach = std::max({body.reach, std::fabs(box.lo[k]), std::fabs(box.hi[k])});
  body.error = primitive_pairs::kSupportRounding * body.reach;
  return body;
}

/// Returns the separation of the convex hulls of two parts with vertices, by Gilbert, Johnson and
/// Keerthi (1988). Stops at a lower bound of `cutoff` grid units; a bound that is not positive
/// means nothing. Costs about ten support queries on either.
[[nodiscard]] SeparationBound convex_hull_separation(const PartWithObb& a, const PartWithObb& b,
                                                     double cutoff);

}  // namespace strake::geometry
