// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/analyse/near_points.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// Corners that count as one, and where: the corner nearest to the middle of their box.
struct CornerCluster {
  std::uint32_t at = 0;
  std::vector<std::uint32_t> members;  ///< ascending, `at` among them
};

/// Of some vertices, those that hang together with each no farther than `within` from the next, as
/// far as none is farther than that from where they are to be. `some` ascending, and the points of
/// `points`. Nothing where very many are near each other, more than corners of solids can be.
[[nodiscard]] std::vector<CornerCluster> near_corners(std::span<const Vec3i> vertices,
                                                      std::span<const std::uint32_t> some,
                                                      const NearPoints& points,
                                                      std::int64_t within);

}  // namespace strake::geometry
