// SPDX-License-Identifier: Apache-2.0
// Closed meshes on the grid whose faces are cut otherwise on either side of an edge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>

#include "support/draw.hpp"
#include "support/slivers.hpp"

namespace strake::test {

/// Splits one side of one triangle, a-c-x, at b: a-b-x and b-c-x, and leaves what stands at a-c.
inline void split_side(geometry::GridMesh& mesh, std::size_t triangle, std::size_t side,
                       const geometry::Vec3i& b) {
  (void)split_and_seal(mesh, triangle, side, b);
  mesh.triangles.pop_back();
  if (!mesh.faces.empty()) mesh.faces.pop_back();
}

/// Splits sides of triangles, and of what comes of them, at drawn points of the grid within them.
/// Returns how many.
inline int split_sides(geometry::GridMesh& mesh, int tries, Draw& draw) {
  int made = 0;
  for (int i = 0; i < tries; ++i) {
    const auto triangle = static_cast<std::size_t>(draw.below(mesh.triangles.size()));
    const auto side = static_cast<std::size_t>(draw.below(3));
    const geometry::Triangle& t = mesh.triangles[triangle];
    const geometry::Vec3i a = mesh.vertices[t[side]], c = mesh.vertices[t[(side + 1) % 3]];
    const geometry::Vec3l way = c.as<std::int64_t>() - a.as<std::int64_t>();
    const std::int64_t steps = std::gcd(std::gcd(way.x, way.y), way.z);
    if (steps < 2) continue;
    const auto part =
        1 + static_cast<std::int64_t>(draw.below(static_cast<std::uint64_t>(steps) - 1));
    split_side(mesh, triangle, side, *grid_point_between(a, c, part, steps));
    ++made;
  }
  return made;
}

}  // namespace strake::test
