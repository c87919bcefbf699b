// SPDX-License-Identifier: Apache-2.0
// Meshes that hang together alike share their connectivity, and nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "support/voxels.hpp"

namespace strake::geometry {
namespace {

/// A prism on the grid; its top may lie below its bottom: then it comes inside out.
GridMesh prism(std::uint32_t sides, double radius, std::int32_t height) {
  GridMesh mesh;
  for (const std::int32_t z : {0, height})
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double turn = 2 * std::acos(-1.0) * (i + 0.3) / sides;
      mesh.vertices.push_back({static_cast<std::int32_t>(std::lround(radius * std::cos(turn))),
                               static_cast<std::int32_t>(std::lround(radius * std::sin(turn))), z});
    }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    mesh.triangles.push_back({i, j, j + sides});
    mesh.triangles.push_back({i, j + sides, i + sides});
    if (i == 0 || j == 0) continue;
    mesh.triangles.push_back({0, j, i});
    mesh.triangles.push_back({sides, i + sides, j + sides});
  }
  return mesh;
}

void expect_same(const RepairedMesh& a, const RepairedMesh& b) {
  EXPECT_EQ(a.findings.degenerate_triangles, b.findings.degenerate_triangles);
  EXPECT_EQ(a.findings.duplicate_triangles, b.findings.duplicate_triangles);
  EXPECT_EQ(a.findings.nested_shells, b.findings.nested_shells);
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    const Part &p = a.parts[i], &q = b.parts[i];
    EXPECT_EQ(p.kind, q.kind);
    EXPECT_EQ(p.flags.inverted, q.flags.inverted);
    EXPECT_EQ(p.flags.open, q.flags.open);
    EXPECT_EQ(p.flags.non_manifold, q.flags.non_manifold);
    EXPECT_EQ(p.vertices, q.vertices);
    EXPECT_EQ(p.triangles, q.triangles);
    EXPECT_EQ(p.faces, q.faces);
    ASSERT_EQ(p.edges.size(), q.edges.size());
    for (std::size_t e = 0; e < p.edges.size(); ++e) {
      EXPECT_EQ(p.edges[e].v0, q.edges[e].v0);
      EXPECT_EQ(p.edges[e].v1, q.edges[e].v1);
      EXPECT_EQ(p.edges[e].first_triangle, q.edges[e].first_triangle);
    }
    EXPECT_EQ(p.edge_triangles, q.edge_triangles);
    EXPECT_EQ(p.shells, q.shells);
    EXPECT_EQ(p.shell_count, q.shell_count);
    EXPECT_EQ(p.box, q.box);
    EXPECT_EQ(p.volume, q.volume);
    EXPECT_EQ(p.area, q.area);
  }
}

TEST(ConnectivityCache, AlikeMeshesShareFromTheSecondOn) {
  MeshRepairer analyser;
  std::vector<Part> parts;
  for (int i = 0; i < 4; ++i) {
    const GridMesh mesh = prism(24, 1000 + 50 * i, 700 + 333 * i);
    RepairedMesh analysis = analyser.repair_mesh(mesh);
    expect_same(analysis, repair_mesh(mesh));
    parts.push_back(std::move(analysis.parts.at(0)));
  }
  EXPECT_NE(parts[0].triangles.data(), parts[1].triangles.data());
  for (std::size_t i = 2; i < 4; ++i) {
    EXPECT_EQ(parts[1].triangles.data(), parts[i].triangles.data());
    EXPECT_EQ(parts[1].edges.data(), parts[i].edges.data());
    EXPECT_EQ(parts[1].edge_triangles.data(), parts[i].edge_triangles.data());
    EXPECT_NE(parts[1].volume, parts[i].volume);
  }
}

TEST(ConnectivityCache, FacesAreDistinguished) {
  MeshRepairer analyser;
  GridMesh mesh = prism(12, 1000, 500);
  for (int round = 0; round < 3; ++round)
    for (const std::uint32_t per_face : {0U, 1U, 2U}) {
      mesh.faces.clear();
      for (std::uint32_t t = 0; per_face > 0 && t < mesh.triangles.size(); ++t)
        mesh.faces.push_back(t / per_face);
      expect_same(analyser.repair_mesh(mesh), repair_mesh(mesh));
    }
}

// What coordinates can do to a mesh of the same triangles in the same order of vertices: turn it
// inside out, take its volume, take the area of some triangles, pinch it to a crowded edge.
TEST(ConnectivityCache, CoordinatesAreRequestedEachTime) {
  MeshRepairer analyser;
  // Two tetrahedra back to back over a triangle whose corners lie apart in x.
  const std::vector<Triangle> triangles{{0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                                        {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  const auto body = [&](std::int32_t y2, std::int32_t z3, std::int32_t z4) {
    return GridMesh{{{0, 0, 0}, {10, 0, 0}, {20, y2, 0}, {30, 9, z3}, {40, 9, z4}}, triangles, {}};
  };
  const std::vector<GridMesh> plain{
      body(9, 8, -8),  body(9, 8, -8), body(9, 3, -5), body(9, -8, 8),  // as it is, then inside out
      body(9, 8, -9),  body(0, 8, -8), body(0, 0, 0),  body(9, 0, 0),   // flat, degenerate
      body(-9, 8, -8), body(9, 8, 8),  body(9, 8, -8)};
  std::vector<GridMesh> meshes = plain;
  meshes.push_back(plain.front());
  meshes.back().vertices[3] = {30, 0, 0};  // in line with the first two corners
  for (int round = 0; round < 3; ++round)
    for (const GridMesh& mesh : meshes) expect_same(analyser.repair_mesh(mesh), repair_mesh(mesh));
}

// Five cubes round a corner: the first and the last touch along an edge.
TEST(ConnectivityCache, PinchedSolidsStayFlagged) {
  test::VoxelSkin skin = test::voxel_skin({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}});
  const GridMesh mesh{std::move(skin.vertices), std::move(skin.triangles), {}};
  MeshRepairer analyser;
  for (int round = 0; round < 3; ++round) {
    const RepairedMesh analysis = analyser.repair_mesh(mesh);
    ASSERT_EQ(analysis.parts.size(), 1U);
    EXPECT_TRUE(analysis.parts[0].flags.non_manifold);
    EXPECT_DOUBLE_EQ(analysis.parts[0].volume, 5);
    expect_same(analysis, repair_mesh(mesh));
  }
}

TEST(ConnectivityCache, RandomMeshesOfFewShapesAreAsAnalysedAlone) {
  MeshRepairer analyser;
  std::mt19937 random(11);
  std::vector<std::vector<Triangle>> shapes;
  for (int s = 0; s < 6; ++s) {
    std::vector<Triangle> triangles = prism(3 + static_cast<std::uint32_t>(s) % 2, 9, 9).triangles;
    if (s >= 2) triangles.pop_back();            // open
    if (s >= 4) triangles.push_back({0, 1, 3});  // crowded
    if (s == 5) triangles.push_back({triangles[0][1], triangles[0][2], triangles[0][0]});  // twice
    shapes.push_back(std::move(triangles));
  }
  int shared = 0;
  std::vector<RepairedMesh> all;
  for (int i = 0; i < 3000; ++i) {
    GridMesh mesh;
    mesh.triangles = shapes[random() % shapes.size()];
    // Mostly a prism somewhat out of shape; now and then a vertex falls on another, or far off.
    mesh.vertices = prism(4, 40, 30).vertices;
    for (Vec3i& v : mesh.vertices) {
      v = v + Vec3i{static_cast<std::int32_t>(random() % 3), 0, 0};
      if (random() % 32 == 0) v = mesh.vertices[random() % mesh.vertices.size()];
      if (random() % 32 == 0) v = v + Vec3i{0, 0, static_cast<std::int32_t>(random() % 300) - 150};
    }
    all.push_back(analyser.repair_mesh(mesh));
    expect_same(all.back(), repair_mesh(mesh));
    for (std::size_t k = 0; k + 1 < all.size() && all.back().parts.size() == 1; ++k)
      if (all[k].parts.size() == 1 && all[k].parts[0].triangles.data() != nullptr &&
          all[k].parts[0].triangles.data() == all.back().parts[0].triangles.data()) {
        ++shared;
        break;
      }
  }
  EXPECT_GT(shared, 100);
}

}  // namespace
}  // namespace strake::geometry
