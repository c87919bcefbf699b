// SPDX-License-Identifier: Apache-2.0
// Meshes with their corners on the grid, for tests of what a mesh is.
#pragma once

#include <cstdint>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "support/voxels.hpp"

namespace strake::test {

inline void append(geometry::GridMesh& mesh, const geometry::GridMesh& other) {
  const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const geometry::Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
}

/// A stair of four cubes, not convex.
inline geometry::GridMesh grid_stair(std::int32_t cube) {
  const VoxelSkin skin = voxel_skin({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}});
  geometry::GridMesh mesh{skin.vertices, skin.triangles, {}};
  for (geometry::Vec3i& v : mesh.vertices) v = v * cube;
  return mesh;
}

/// The projective plane of six corners: it closes, and has one side only.
inline geometry::GridMesh one_sided_mesh() {
  return {{{0, 0, 0},
           {500, 100, 200},
           {100, 700, 300},
           {400, 200, 900},
           {800, 600, 100},
           {300, 800, 700}},
          {{0, 1, 2},
           {0, 2, 3},
           {0, 3, 4},
           {0, 4, 5},
           {0, 5, 1},
           {1, 2, 4},
           {2, 3, 5},
           {3, 4, 1},
           {4, 5, 2},
           {5, 1, 3}},
          {}};
}

}  // namespace strake::test
