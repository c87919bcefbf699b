// SPDX-License-Identifier: Apache-2.0
// Bodies made of unit cubes: any shape of right angles, with the truth easy to count.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "strake/geometry/mesh.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::test {

struct VoxelSkin {
  std::vector<geometry::Vec3i> vertices;
  std::vector<geometry::Triangle> triangles;  ///< outward
};

/// The skin of the union of unit cubes, given by their low corners: two triangles for each face
/// that only one cube has.
inline VoxelSkin voxel_skin(const std::vector<geometry::Vec3i>& cubes) {
  using geometry::Vec3i;
  const std::set<Vec3i> solid(cubes.begin(), cubes.end());
  VoxelSkin skin;
  std::map<Vec3i, std::uint32_t> number;
  const auto vertex = [&](const Vec3i& at) {
    const auto [it, fresh] = number.emplace(at, static_cast<std::uint32_t>(skin.vertices.size()));
    if (fresh) skin.vertices.push_back(at);
    return it->second;
  };
  for (const Vec3i& cube : solid)
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        Vec3i beside = cube, u{}, v{};
        beside[axis] += side == 0 ? -1 : 1;
        if (solid.contains(beside)) continue;
        u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
        if (side == 0) std::swap(u, v);
        Vec3i at = cube;
        at[axis] += side;
        const std::uint32_t a = vertex(at), b = vertex(at + u), c = vertex(at + u + v),
                            d = vertex(at + v);
        skin.triangles.push_back({a, b, c});
        skin.triangles.push_back({a, c, d});
      }
  return skin;
}

/// The same in millimetres.
inline geometry::TriangleMesh voxel_mesh(const std::vector<geometry::Vec3i>& cubes, double size) {
  const VoxelSkin skin = voxel_skin(cubes);
  geometry::TriangleMesh mesh;
  for (const geometry::Vec3i& v : skin.vertices) mesh.vertices.push_back(v.as<double>() * size);
  mesh.triangles = skin.triangles;
  return mesh;
}

}  // namespace strake::test
