// SPDX-License-Identifier: Apache-2.0
#include "clearance.hpp"

namespace convert {

bool comes_near(const Box& box, const Valve& valve) {
  if (box.is_empty()) return false;
  const std::array<std::int32_t, 3> at{valve.at.x, valve.at.y, valve.at.z};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (box.lo[axis] >= at[axis] + valve.clearance || box.hi[axis] <= at[axis] - valve.clearance)
      return false;
  return true;
}

}  // namespace convert
