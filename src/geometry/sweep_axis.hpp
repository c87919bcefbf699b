// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// The axis along which boxes are shortest in relation to all that is swept. `lengths`: of one box,
/// or the sums of several.
[[nodiscard]] inline int best_axis(const Vec3d& lengths, const Box3d& within) {
  int best = 0;
  for (int k = 1; k < 3; ++k)
    if (lengths[k] * (within.hi[best] - within.lo[best]) <
        lengths[best] * (within.hi[k] - within.lo[k]))
      best = k;
  return best;
}

}  // namespace strake::geometry
