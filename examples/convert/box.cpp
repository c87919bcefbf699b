// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "bounding_box.hpp"

namespace convert {

void Box::add(const Point& p) {
  const std::array<std::int32_t, 3> at{p.x, p.y, p.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lo[axis] = std::min(lo[axis], at[axis]);
    hi[axis] = std::max(hi[axis], at[axis]);
  }
}

void Box::add(const Box& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lo[axis] = std::min(lo[axis], other.lo[axis]);
    hi[axis] = std::max(hi[axis], other.hi[axis]);
  }
}

void Extent::widen(std::size_t axis, std::int32_t lo, std::uint32_t lo_part, std::int32_t hi,
                   std::uint32_t hi_part) {
  // Less, not less or equal: of parts that reach equally far the first one stays.
  if (lo < box.lo[axis]) {
    box.lo[axis] = lo;
    reached_by[axis] = lo_part;
  }
  if (hi > box.hi[axis]) {
    box.hi[axis] = hi;
    reached_by[axis + 3] = hi_part;
  }
}

void Extent::add(const Box& other, std::uint32_t part) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    widen(axis, other.lo[axis], part, other.hi[axis], part);
}

void Extent::add(const Extent& other) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    widen(axis, other.box.lo[axis], other.reached_by[axis], other.box.hi[axis],
          other.reached_by[axis + 3]);
}

}  // namespace convert
