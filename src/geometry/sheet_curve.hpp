// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {

/// Where two sheets cross: segments in grid units relative to a's origin.
struct CrossingCurve {
  std::vector<std::array<Vec3d, 2>> segments;
  bool truncated = false;  ///< there may be more
};

/// The segments along which one sheet passes from one side of the other to the other side. Where
/// they lie on each other, they cross if somewhere along the rim of that common area a goes on to
/// one side of b and elsewhere to the other; the segments then are those of the rim where it does
/// so. Touching from one side is no crossing, nor is a sheet that ends on the other.
///
/// Which segments these are is exact, where they lie is rounded. Stops after `most` segments that
/// cross outright. The cost is that of the contacts.
[[nodiscard]] CrossingCurve crossing_curve(const TreedPart& a, const TreedPart& b, std::size_t most,
                                           PairWork& work);

}  // namespace strake::geometry
