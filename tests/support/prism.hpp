// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <numbers>

#include "strake/geometry/mesh.hpp"

namespace strake::test {

/// A prism along z between two heights over a convex outline: corner(angle, z) is a corner of it,
/// for `n` angles that go round evenly.
template <class Corner>
[[nodiscard]] geometry::TriangleMesh prism(std::uint32_t n, double z0, double z1,
                                           const Corner& corner) {
  geometry::TriangleMesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    mesh.vertices.push_back(corner(angle, z0));
    mesh.vertices.push_back(corner(angle, z1));
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
    if (i == 0 || i + 1 == n) continue;
    mesh.triangles.push_back({0, b, a});
    mesh.triangles.push_back({1, a + 1, b + 1});
  }
  return mesh;
}

}  // namespace strake::test
