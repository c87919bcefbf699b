// SPDX-License-Identifier: Apache-2.0
// Closed meshes on the grid with triangles of no area that seal what would else be T-junctions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "support/meshes.hpp"

namespace strake::test {

/// A box with its corners on the grid.
inline geometry::GridMesh grid_box(const geometry::Vec3i& lo, const geometry::Vec3i& hi,
                                   bool inside_out = false) {
  const geometry::TriangleMesh box =
      box_mesh(lo.as<double>(), hi.as<double>(), inside_out);  // corners as they are: no unit
  geometry::GridMesh mesh;
  for (const geometry::Vec3d& v : box.vertices) mesh.vertices.push_back(v.as<std::int32_t>());
  mesh.triangles = box.triangles;
  return mesh;
}

/// The point of a segment at `part` / `parts` if it is on the grid.
inline std::optional<geometry::Vec3i> grid_point_between(const geometry::Vec3i& a,
                                                         const geometry::Vec3i& c,
                                                         std::int64_t part, std::int64_t parts) {
  geometry::Vec3i p;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t way = (std::int64_t{c[k]} - a[k]) * part;
    if (way % parts != 0) return std::nullopt;
    p[k] = static_cast<std::int32_t>(a[k] + way / parts);
  }
  return p;
}

/// Splits one side of one triangle, a-c-x, at b: a-b-x and b-c-x, and closes the gap to whatever
/// stands at a-c with a-c-b, of no area where b is on a-c. Returns the number of the last.
inline std::size_t split_and_seal(geometry::GridMesh& mesh, std::size_t triangle, std::size_t side,
                                  const geometry::Vec3i& b_at) {
  const geometry::Triangle t = mesh.triangles[triangle];
  const std::uint32_t a = t[side], c = t[(side + 1) % 3], x = t[(side + 2) % 3];
  const auto b = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(b_at);
  mesh.triangles[triangle] = {a, b, x};
  mesh.triangles.push_back({b, c, x});
  mesh.triangles.push_back({a, c, b});
  if (!mesh.faces.empty()) mesh.faces.resize(mesh.triangles.size(), mesh.faces[triangle]);
  return mesh.triangles.size() - 1;
}

}  // namespace strake::test
