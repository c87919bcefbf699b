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

/// The segments of crossing_pieces(): which these are is exact, where they lie is rounded.
[[nodiscard]] CrossingCurve crossing_curve(const TreedPart& a, const TreedPart& b, std::size_t most,
                                           PairWork& work);

}  // namespace strake::geometry
