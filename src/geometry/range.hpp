// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// Heights along a direction; empty at first.
struct Range {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();

  void include(double at) { include(Range{at, at}); }
  void include(const Range& other) {
    lo = std::min(lo, other.lo);
    hi = std::max(hi, other.hi);
  }
};

/// Of the corners of a box that is not empty.
[[nodiscard]] inline Range range_along(const Box3d& box, const Vec3d& axis) {
  Range r{0, 0};
  for (int k = 0; k < 3; ++k) {
    const double x = axis[k] * box.lo[k], y = axis[k] * box.hi[k];
    r.lo += std::min(x, y);
    r.hi += std::max(x, y);
  }
  return r;
}

}  // namespace strake::geometry
