// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "strake/geometry/mesh.hpp"

namespace strake::test {

/// Adds a box with outward triangles (inward when `inside_out`), every corner listed once.
inline void add_box(geometry::TriangleMesh& mesh, const geometry::Vec3d& lo,
                    const geometry::Vec3d& hi, bool inside_out = false) {
  static constexpr std::array<std::array<std::uint32_t, 4>, 6> kQuads{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < 8; ++i)
    mesh.vertices.push_back(
        {(i & 1U) != 0 ? hi.x : lo.x, (i & 2U) != 0 ? hi.y : lo.y, (i & 4U) != 0 ? hi.z : lo.z});
  for (const auto& q : kQuads) {
    const std::uint32_t a = base + q[0], b = base + q[1], c = base + q[2], d = base + q[3];
    if (inside_out) {
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({a, d, c});
    } else {
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
}

inline geometry::TriangleMesh box_mesh(const geometry::Vec3d& lo, const geometry::Vec3d& hi,
                                       bool inside_out = false) {
  geometry::TriangleMesh mesh;
  add_box(mesh, lo, hi, inside_out);
  return mesh;
}

}  // namespace strake::test
