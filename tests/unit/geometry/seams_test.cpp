// SPDX-License-Identifier: Apache-2.0
// Triangles without area hold a skin together as any other, and no part has one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/snap_to_grid.hpp"
#include "geometry/mesh_repair/t_junctions.hpp"
#include "support/rounds.hpp"
#include "support/slivers.hpp"

namespace strake::geometry {
namespace {

using test::add_box;
using test::grid_box;
using test::split_and_seal;

constexpr std::int32_t kSize = 1'000'000;
constexpr double kVolume = 1e18;

GridMesh cube() { return grid_box({0, 0, 0}, {kSize, kSize, kSize}); }

/// The triangle and side that run from one corner of the cube to another.
std::pair<std::size_t, std::size_t> side_from(const GridMesh& mesh, const Vec3i& a,
                                              const Vec3i& c) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (mesh.vertices[mesh.triangles[t][k]] == a &&
          mesh.vertices[mesh.triangles[t][(k + 1) % 3]] == c)
        return {t, k};
  ADD_FAILURE() << "no such side";
  return {};
}

std::size_t split_at(GridMesh& mesh, const Vec3i& a, const Vec3i& c, const Vec3i& b) {
  const auto [triangle, side] = side_from(mesh, a, c);
  return split_and_seal(mesh, triangle, side, b);
}

bool has_area(const Part& part, const Triangle& t) {
  const Vec3l p = part.vertices[t[0]].as<std::int64_t>();
  return cross(part.vertices[t[1]].as<std::int64_t>() - p,
               part.vertices[t[2]].as<std::int64_t>() - p) != Vec3l{0, 0, 0};
}

/// What is left of a welded mesh without its triangles of no area, and the same cut.
struct Cut {
  std::vector<Triangle> before;
  std::optional<CutMesh> after;
};

Cut cut(const std::vector<Vec3i>& vertices, const std::vector<Triangle>& triangles) {
  GridMesh mesh{vertices, triangles, {}};
  Part part;
  part.vertices = vertices;
  std::erase_if(mesh.triangles, [&](const Triangle& t) { return !has_area(part, t); });
  TopologyScratch scratch;
  const Topology topology = make_topology(vertices.size(), mesh.triangles, scratch);
  return {mesh.triangles, split_at_t_junctions(mesh, topology)};
}

/// One solid with the skin of the cube, each edge between two triangles.
void expect_cube(const GridMesh& mesh, double volume = kVolume, double area = 6e12) {
  const RepairedMesh a = repair_mesh(mesh);
  ASSERT_EQ(a.parts.size(), 1U);
  const Part& p = a.parts[0];
  EXPECT_EQ(p.kind, PartKind::solid);
  EXPECT_FALSE(p.flags.open || p.flags.inverted || p.flags.non_manifold);
  EXPECT_EQ(p.shell_count, 1U);
  EXPECT_DOUBLE_EQ(p.volume, volume);
  EXPECT_NEAR(p.area, area, 1e-9 * area);
  for (const Triangle& t : p.triangles) EXPECT_TRUE(has_area(p, t));
  for (std::size_t e = 0; e + 1 < p.edges.size(); ++e)
    EXPECT_EQ(p.edges[e + 1].first_triangle - p.edges[e].first_triangle, 2U);
}

TEST(Seams, CornerOnAnEdgeOfAnother) {
  GridMesh mesh = cube();
  split_at(mesh, {0, 0, kSize}, {kSize, 0, kSize}, {kSize / 2, 0, kSize});
  const RepairedMesh a = repair_mesh(mesh);
  EXPECT_EQ(a.findings.degenerate_triangles, 1U);
  EXPECT_EQ(a.findings.cut_triangles, 1U);
  EXPECT_EQ(a.parts.at(0).triangles.size(), 14U);
  expect_cube(mesh);
}

TEST(Seams, FlatOnlyAfterTheSnap) {
  TriangleMesh mesh = test::box_mesh({0, 0, 0}, {1000, 1000, 1000});
  const auto m = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({500, 0.0003, 1000});
  const auto top = std::ranges::find_if(mesh.triangles,
                                        [](const Triangle& t) { return t == Triangle{4, 5, 7}; });
  ASSERT_NE(top, mesh.triangles.end());
  *top = {4, m, 7};
  mesh.triangles.push_back({m, 5, 7});
  mesh.triangles.push_back({4, 5, m});
  const auto placed = snap_to_grid(mesh, {});
  ASSERT_TRUE(placed.has_value());
  expect_cube(placed->mesh);
}

TEST(Seams, SeveralOnOneEdgeFromBothSides) {
  const Vec3i a{0, 0, kSize}, c{kSize, 0, kSize};
  GridMesh mesh = cube();
  const auto on = [&](std::int32_t x) { return Vec3i{x, 0, kSize}; };
  split_at(mesh, a, c, on(500'000));
  split_at(mesh, a, on(500'000), on(100'000));
  split_at(mesh, on(100'000), on(500'000), on(300'000));
  split_at(mesh, c, a, on(700'000));
  split_at(mesh, on(700'000), a, on(300'000));  // where the other side has one too
  EXPECT_EQ(repair_mesh(mesh).findings.degenerate_triangles, 5U);
  expect_cube(mesh);
  // A needle that folds back lies in the face: a surface of its own beside the solid.
  split_at(mesh, on(300'000), a, on(300'100));
  const RepairedMesh found = repair_mesh(mesh);
  EXPECT_EQ(found.parts.at(0).kind, PartKind::solid);
  EXPECT_DOUBLE_EQ(found.parts[0].volume, kVolume);
  for (std::size_t i = 1; i < found.parts.size(); ++i) EXPECT_LT(found.parts[i].area, 1e-3 * 6e12);
}

TEST(Seams, FanAlongOneEdge) {
  // All but one of the thin triangles stand on the first corner: each but the last between two.
  GridMesh mesh = cube();
  Vec3i far{kSize, 0, kSize};
  for (std::int32_t x = 9; x > 0; --x) {
    const Vec3i at{x * 100'000, 0, kSize};
    split_at(mesh, {0, 0, kSize}, far, at);
    far = at;
  }
  EXPECT_EQ(repair_mesh(mesh).findings.cut_triangles, 1U);
  expect_cube(mesh);
}

TEST(Seams, AllThreeSidesOfATriangle) {
  GridMesh mesh = cube();
  const auto [triangle, side] = side_from(mesh, {0, 0, kSize}, {kSize, 0, kSize});
  const Triangle t = mesh.triangles[triangle];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3i a = mesh.vertices[t[k]], c = mesh.vertices[t[(k + 1) % 3]];
    const Vec3i quarter{a.x + (c.x - a.x) / 4, a.y + (c.y - a.y) / 4, a.z + (c.z - a.z) / 4};
    split_at(mesh, c, a, quarter);
  }
  const RepairedMesh found = repair_mesh(mesh);
  EXPECT_EQ(found.findings.cut_triangles, 1U);
  EXPECT_EQ(found.parts.at(0).triangles.size(), 18U);
  expect_cube(mesh);
}

/// A band of no height round the cube, its two rims with corners of their own.
TEST(Seams, ClosedStripRoundABody) {
  GridMesh mesh;
  const auto ring = [&](std::int32_t z, std::int32_t middle) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& [x, y] : std::array<std::array<std::int32_t, 2>, 8>{{{0, 0},
                                                                          {middle, 0},
                                                                          {kSize, 0},
                                                                          {kSize, middle},
                                                                          {kSize, kSize},
                                                                          {middle, kSize},
                                                                          {0, kSize},
                                                                          {0, middle}}})
      mesh.vertices.push_back({x, y, z});
    return first;
  };
  const std::array<std::uint32_t, 4> rings{ring(0, kSize / 2), ring(kSize / 2, kSize / 4),
                                           ring(kSize / 2, kSize / 8 * 5), ring(kSize, kSize / 2)};
  for (std::size_t r = 0; r + 1 < rings.size(); ++r)
    for (std::uint32_t i = 0; i < 8; ++i) {
      const std::uint32_t j = (i + 1) % 8, low = rings[r], high = rings[r + 1];
      mesh.triangles.push_back({low + i, low + j, high + j});
      mesh.triangles.push_back({low + i, high + j, high + i});
    }
  for (std::uint32_t i = 1; i + 1 < 8; ++i) {
    mesh.triangles.push_back({rings[0], rings[0] + i + 1, rings[0] + i});
    mesh.triangles.push_back({rings[3], rings[3] + i, rings[3] + i + 1});
  }
  EXPECT_GE(repair_mesh(mesh).findings.degenerate_triangles, 16U);
  expect_cube(mesh);
}

TEST(Seams, NeedlesThatFoldBackLeaveASolid) {
  // The corner that is pushed onto the edge of its neighbour is the neighbour's own.
  GridMesh mesh = cube();
  const std::size_t seal = split_at(mesh, {0, 0, kSize}, {kSize, 0, kSize}, {kSize / 2, 0, kSize});
  for (std::size_t k = 0; k < 3; ++k) {
    GridMesh folded = mesh;
    const Triangle t = folded.triangles[seal];
    const Vec3i a = folded.vertices[t[k]], c = folded.vertices[t[(k + 1) % 3]];
    // Beyond the far end of the side: the thin triangle runs there and back.
    split_and_seal(folded, seal, k,
                   {a.x + (c.x - a.x) * 2, a.y + (c.y - a.y) * 2, a.z + (c.z - a.z) * 2});
    const RepairedMesh found = repair_mesh(folded);
    ASSERT_EQ(found.parts.size(), 1U) << k;
    EXPECT_EQ(found.parts[0].kind, PartKind::solid);
    EXPECT_DOUBLE_EQ(found.parts[0].volume, kVolume);
  }
}

TEST(Seams, WhatSealsNothingIsOnlyLeftOut) {
  GridMesh mesh = cube();
  mesh.vertices.push_back({kSize / 2, 0, 0});
  mesh.triangles.push_back({0, 8, 1});
  mesh.triangles.push_back({0, 0, 5});
  const RepairedMesh a = repair_mesh(mesh);
  EXPECT_EQ(a.findings.degenerate_triangles, 2U);
  EXPECT_EQ(a.findings.cut_triangles, 0U);
  EXPECT_EQ(a.parts.at(0).triangles.size(), 12U);
  // At the rim of a surface as well.
  mesh.triangles.erase(mesh.triangles.begin());
  EXPECT_EQ(repair_mesh(mesh).findings.cut_triangles, 0U);
  EXPECT_EQ(repair_mesh(mesh).parts.at(0).kind, PartKind::sheet);
}

TEST(Seams, SkinsDrawnFromBothSidesAndInsideOut) {
  GridMesh mesh = cube();
  split_at(mesh, {0, 0, kSize}, {kSize, 0, kSize}, {kSize / 2, 0, kSize});
  GridMesh inside_out = mesh;
  for (Triangle& t : inside_out.triangles) std::swap(t[1], t[2]);
  const RepairedMesh turned = repair_mesh(inside_out);
  EXPECT_TRUE(turned.parts.at(0).flags.inverted);
  EXPECT_DOUBLE_EQ(turned.parts.at(0).volume, kVolume);
  GridMesh both = mesh;
  both.triangles.insert(both.triangles.end(), inside_out.triangles.begin(),
                        inside_out.triangles.end());
  const RepairedMesh a = repair_mesh(both);
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_EQ(a.parts[0].kind, PartKind::solid);
  EXPECT_EQ(a.findings.two_sided_shells, 1U);
  GridMesh twice = mesh;
  twice.triangles.insert(twice.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  expect_cube(twice);
}

TEST(Seams, FacesGoWithTheirPieces) {
  GridMesh mesh = cube();
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) mesh.faces.push_back(i / 2);
  split_at(mesh, {0, 0, kSize}, {kSize, 0, kSize}, {kSize / 2, 0, kSize});
  const Part part = repair_mesh(mesh).parts.at(0);
  ASSERT_EQ(part.faces.size(), part.triangles.size());
  std::map<std::uint32_t, int> count;
  for (const std::uint32_t f : part.faces) ++count[f];
  EXPECT_EQ(count.size(), 6U);
}

TEST(Seams, OneThatLosesAndGainsATriangleIsNotHeldForPlain) {
  // As many triangles as it came with, yet not the same ones: it must not lend its connectivity.
  GridMesh mesh = cube();
  split_at(mesh, {0, 0, kSize}, {kSize, 0, kSize}, {kSize / 2, 0, kSize});
  GridMesh raised = mesh;
  raised.vertices.back().z += 1;
  MeshRepairer analyser;
  for (int round = 0; round < 3; ++round) (void)analyser.repair_mesh(mesh);
  const RepairedMesh a = analyser.repair_mesh(raised);
  EXPECT_EQ(a.findings.degenerate_triangles, 0U);
  EXPECT_EQ(a.parts.at(0).triangles, repair_mesh(raised).parts.at(0).triangles);
}

using EdgeSums = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

EdgeSums unbalanced(std::span<const Triangle> triangles) {
  EdgeSums sums;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t u = t[k], v = t[(k + 1) % 3];
      if (u != v) sums[{std::min(u, v), std::max(u, v)}] += u < v ? 1 : -1;
    }
  std::erase_if(sums, [](const auto& entry) { return entry.second == 0; });
  return sums;
}

/// Closed meshes whose corners are thrown onto so few places that most triangles have no area.
TEST(Seams, WhatIsClosedStaysClosedWhateverCollapses) {
  std::uint64_t cuts = 0;
  for (std::uint32_t seed = 0; seed < test::rounds(4'000U, 400'000U); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    GridMesh mesh = cube();
    for (int i = 0; i < 12; ++i)
      split_and_seal(mesh, random() % mesh.triangles.size(), random() % 3, {0, 0, 0});
    const auto places = static_cast<std::uint32_t>(2 + random() % 4);
    const auto flat = random() % 3;
    std::vector<Vec3i> vertices;
    std::vector<std::array<std::int32_t, 3>> at;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      at.push_back({static_cast<std::int32_t>(random() % places),
                    static_cast<std::int32_t>(random() % (flat > 0 ? 2 : places)),
                    static_cast<std::int32_t>(random() % (flat > 1 ? 2 : places))});
    auto sorted = at;
    std::ranges::sort(sorted);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    for (const auto& p : sorted) vertices.push_back({p[0], p[1], p[2]});
    std::vector<Triangle> triangles = mesh.triangles;
    for (Triangle& t : triangles)
      for (std::uint32_t& v : t)
        v = static_cast<std::uint32_t>(std::ranges::lower_bound(sorted, at[v]) - sorted.begin());
    ASSERT_TRUE(unbalanced(triangles).empty());
    const auto [solid, seamless] = cut(vertices, triangles);
    if (!seamless) {
      // Then those with an area close without more.
      EXPECT_TRUE(unbalanced(solid).empty());
      continue;
    }
    ++cuts;
    EXPECT_TRUE(unbalanced(seamless->triangles).empty());
    Part part;
    part.vertices = vertices;
    for (const Triangle& t : seamless->triangles) EXPECT_TRUE(has_area(part, t));
    // Triangles may come to lie on their opposites by it: then more edges may be cut, and match.
    if (const auto twice = cut(vertices, seamless->triangles).after) {
      EXPECT_TRUE(unbalanced(twice->triangles).empty());
    }
    // No solid has lost its skin to it.
    mesh.vertices = vertices;
    mesh.triangles = triangles;
    for (const Part& p : repair_mesh(mesh).parts) {
      const EdgeSums rims =
          unbalanced(std::vector<Triangle>(p.triangles.begin(), p.triangles.end()));
      EXPECT_TRUE(p.kind == PartKind::sheet || rims.empty());
    }
    // The same from the same triangles in another order.
    std::ranges::shuffle(mesh.triangles, random);
    for (Triangle& t : mesh.triangles) std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    const auto again = cut(vertices, mesh.triangles).after;
    ASSERT_TRUE(again.has_value());
    const GridMesh one{vertices, seamless->triangles, {}}, other{vertices, again->triangles, {}};
    const RepairedMesh a = repair_mesh(one), b = repair_mesh(other);
    ASSERT_EQ(a.parts.size(), b.parts.size());
    for (std::size_t i = 0; i < a.parts.size(); ++i)
      EXPECT_EQ(a.parts[i].triangles, b.parts[i].triangles);
  }
  EXPECT_GT(cuts, 1'000U);
}

}  // namespace
}  // namespace strake::geometry
