// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/pair_view.hpp"

namespace strake::geometry {

/// A coordinate plane in which many triangles of each of two solids lie, those of either all facing
/// one way. Numbers are ascending.
struct FlushPlane {
  int axis = 0;
  std::int64_t height = 0;               ///< in the coordinates of the pair
  std::vector<std::uint32_t> a, b;       ///< all triangles in the plane
  std::vector<std::uint32_t> through_a;  ///< the others that meet it in more than their own rim
  std::vector<std::uint32_t> through_b;  ///< of `a`, or of `b`, and single points
};

/// The planes with the most pairs of triangles, as few as are worth a look; none where they hold
/// but a small share of all. O(n log n).
[[nodiscard]] std::vector<FlushPlane> flush_planes(const PartView& a, const PartView& b);

}  // namespace strake::geometry
