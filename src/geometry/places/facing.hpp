// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/heights.hpp"
#include "geometry/pair_view.hpp"

namespace strake::geometry {

/// What of two parts may be within reach of the other, by a slab between them: of bodies that lie
/// flush on each other little, of others all.
struct Facing {
  SlabHeights heights;
  std::vector<std::uint32_t> triangles_a = {}, triangles_b = {};  ///< ascending
  std::vector<std::uint32_t> vertices_a = {};                     ///< of triangles_a, ascending
  std::vector<std::uint32_t> edges_a = {};  ///< between two of these, ascending
};

/// By the slab between the hulls of two parts. `reach`: grid units.
[[nodiscard]] SlabHeights slab_heights(const PartView& a, const PartView& b, double reach);

/// `reach`: grid units. Costs a walk over all vertices and triangles.
[[nodiscard]] Facing facing(const PartView& a, const PartView& b, double reach);

}  // namespace strake::geometry
