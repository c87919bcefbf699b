// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/pair_view.hpp"

namespace strake::geometry {

/// The triangles of two parts that a slab between the two ends at.
struct SlabFaces {
  std::vector<std::uint32_t> a, b;
  double beyond = 0;  ///< grid units: a pair with a triangle not listed is farther apart, certainly
};

/// `normal`: unit, from b to a. Nothing where one of the parts has more than `most` such triangles.
/// Follows the trees: the cost is that of the triangles found.
[[nodiscard]] std::optional<SlabFaces> slab_faces(const PartView& a, const PartView& b,
                                                  const Vec3d& normal, std::size_t most);

}  // namespace strake::geometry
