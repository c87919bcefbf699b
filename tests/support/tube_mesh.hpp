// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace strake::test {

/// A tube round z between two heights with `sides` facets within and as many without; corner(x, y,
/// z) makes a vertex.
template <class Mesh, class Corner>
Mesh tube(std::uint32_t sides, double outer, double inner, double z0, double z1,
          const Corner& corner) {
  Mesh mesh;
  for (const double z : {z0, z1})
    for (const double r : {outer, inner})
      for (std::uint32_t i = 0; i < sides; ++i) {
        const double t = 2 * std::numbers::pi * i / sides;
        mesh.vertices.push_back(corner(r * std::cos(t), r * std::sin(t), z));
      }
  // Rings of corners: outer and inner below, outer and inner above.
  const auto band = [&](std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t j = (i + 1) % sides;
      mesh.triangles.push_back({from * sides + i, from * sides + j, to * sides + j});
      mesh.triangles.push_back({from * sides + i, to * sides + j, to * sides + i});
    }
  };
  for (const auto& [from, to] :
       std::array<std::array<std::uint32_t, 2>, 4>{{{0, 2}, {2, 3}, {3, 1}, {1, 0}}})
    band(from, to);
  return mesh;
}

}  // namespace strake::test
