// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace convert {

/// Relative to a valve, in millimetres.
struct Offset {
  double x = 0, y = 0, z = 0;
};

/// The square of the distance from the origin to a triangle, which may be degenerate.
double squared_distance(const Offset& a, const Offset& b, const Offset& c);

}  // namespace convert
