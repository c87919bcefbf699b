// SPDX-License-Identifier: Apache-2.0
// Corners that lie exactly on an edge close a skin as any other; what is open stays open.
#include "support/t_junctions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/t_junctions.hpp"
#include "support/grid_bodies.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using test::append;
using test::Draw;
using test::grid_box;
using test::grid_stair;
using test::split_side;
using test::split_sides;

constexpr std::int32_t kSize = 720'720;  // many divisors

GridMesh cube() { return grid_box({0, 0, 0}, {kSize, kSize, kSize}); }

GridMesh split_cube(Draw& draw) {
  GridMesh mesh = cube();
  split_sides(mesh, 40, draw);
  return mesh;
}

bool is_rim(const Part& part, std::size_t edge) {
  return part.edges[edge + 1].first_triangle - part.edges[edge].first_triangle == 1;
}

double length_of_rim(const Part& part) {
  double sum = 0;
  for (std::size_t e = 0; e + 1 < part.edges.size(); ++e) {
    const Vec3d way =
        (part.vertices[part.edges[e].v1] - part.vertices[part.edges[e].v0]).as<double>();
    if (is_rim(part, e)) sum += std::sqrt(dot(way, way));
  }
  return sum;
}

/// The same solid as the mesh before its sides were split: nothing has moved and all edges match.
void expect_closed(const GridMesh& mesh, const Part& whole) {
  const RepairedMesh found = repair_mesh(mesh);
  ASSERT_EQ(found.parts.size(), 1U);
  const Part& part = found.parts[0];
  EXPECT_EQ(part.kind, PartKind::solid);
  EXPECT_FALSE(part.flags.open || part.flags.non_manifold);
  EXPECT_EQ(part.volume, whole.volume);
  EXPECT_NEAR(part.area, whole.area, 1e-9 * whole.area);
  EXPECT_EQ(part.box, whole.box);
  EXPECT_EQ(part.shell_count, whole.shell_count);
  for (std::size_t e = 0; e + 1 < part.edges.size(); ++e)
    EXPECT_EQ(part.edges[e + 1].first_triangle - part.edges[e].first_triangle, 2U);
  for (const Triangle& t : part.triangles) {
    const Vec3l a = part.vertices[t[0]].as<std::int64_t>();
    EXPECT_NE(cross(part.vertices[t[1]].as<std::int64_t>() - a,
                    part.vertices[t[2]].as<std::int64_t>() - a),
              (Vec3l{0, 0, 0}));
  }
  // What was cut is whole now.
  const GridMesh again{part.vertices, part.triangles.to_vector(), {}};
  EXPECT_EQ(repair_mesh(again).findings.cut_triangles, 0U);
}

TEST(TJunctions, ACornerOnTheEdgeOfAnother) {
  GridMesh mesh = cube();
  split_side(mesh, 0, 0,
             *test::grid_point_between(mesh.vertices[mesh.triangles[0][0]],
                                       mesh.vertices[mesh.triangles[0][1]], 1, 3));
  const RepairedMesh found = repair_mesh(mesh);
  EXPECT_EQ(found.findings.cut_triangles, 1U);
  EXPECT_EQ(found.findings.degenerate_triangles, 0U);
  EXPECT_EQ(found.parts.at(0).triangles.size(), 14U);
  expect_closed(mesh, repair_mesh(cube()).parts[0]);
}

TEST(TJunctions, ManyCornersOnBothSidesOfEveryEdge) {
  for (const GridMesh& whole : {cube(), grid_stair(5040)}) {
    const Part part = repair_mesh(whole).parts.at(0);
    for (std::uint64_t seed = 1; seed <= test::rounds(200U, 20'000U); ++seed) {
      SCOPED_TRACE(seed);
      Draw draw(seed);
      GridMesh mesh = whole;
      EXPECT_GT(split_sides(mesh, 1 << draw.below(9), draw), 0);
      expect_closed(mesh, part);
    }
  }
}

TEST(TJunctions, TheSameWhateverTheOrderAndTheSideThatItIsSeenFrom) {
  for (std::uint64_t seed = 1; seed <= test::rounds(50U, 5'000U); ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    GridMesh mesh = split_cube(draw);
    const Part first = repair_mesh(mesh).parts.at(0);
    for (std::size_t i = mesh.triangles.size() - 1; i > 0; --i)
      std::swap(mesh.triangles[i], mesh.triangles[draw.below(i + 1)]);
    for (Triangle& t : mesh.triangles)
      std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(draw.below(3)), t.end());
    EXPECT_EQ(repair_mesh(mesh).parts.at(0).triangles, first.triangles);
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    const Part turned = repair_mesh(mesh).parts.at(0);
    EXPECT_TRUE(turned.flags.inverted);
    EXPECT_EQ(turned.triangles, first.triangles);
  }
}

TEST(TJunctions, AMicrometreBesideTheEdgeIsNotOnIt) {
  GridMesh mesh = cube();
  Vec3i at = *test::grid_point_between(mesh.vertices[mesh.triangles[0][0]],
                                       mesh.vertices[mesh.triangles[0][1]], 1, 3);
  at.z += at.z == 0 ? 1 : -1;
  at.x += at.x == 0 ? 1 : at.x == kSize ? -1 : 0;
  split_side(mesh, 0, 0, at);
  const RepairedMesh found = repair_mesh(mesh);
  EXPECT_EQ(found.findings.cut_triangles, 0U);
  EXPECT_EQ(found.parts.at(0).kind, PartKind::sheet);
}

/// A box without a lid: it stays a sheet, and its rim is its rim alone.
TEST(TJunctions, WhatIsOpenStaysOpen) {
  GridMesh open = cube();
  std::erase_if(open.triangles, [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return open.vertices[v].z == kSize; });
  });
  ASSERT_EQ(open.triangles.size(), 10U);
  const double area = repair_mesh(open).parts.at(0).area;
  for (std::uint64_t seed = 1; seed <= test::rounds(100U, 10'000U); ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    GridMesh mesh = open;
    split_sides(mesh, 60, draw);
    const RepairedMesh found = repair_mesh(mesh);
    ASSERT_EQ(found.parts.size(), 1U);
    EXPECT_EQ(found.parts[0].kind, PartKind::sheet);
    EXPECT_NEAR(found.parts[0].area, area, 1e-9 * area);
    EXPECT_NEAR(length_of_rim(found.parts[0]), 4.0 * kSize, 1e-3);
  }
}

TEST(TJunctions, CornersAlongARimAreNone) {
  // A plate in strips: all corners of one side on one line, and nothing on the other side of it.
  GridMesh plate;
  constexpr std::uint32_t kStrips = 500;
  for (std::uint32_t i = 0; i <= kStrips; ++i)
    for (const std::int32_t y : {0, 1000})
      plate.vertices.push_back({static_cast<int>(i) * 10, y, 0});
  for (std::uint32_t i = 0; i < kStrips; ++i) {
    plate.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    plate.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  EXPECT_EQ(repair_mesh(plate).findings.cut_triangles, 0U);
  // A second one that goes on from it in one piece is cut into as many.
  const auto n = static_cast<std::uint32_t>(plate.vertices.size());
  plate.vertices.push_back({kStrips * 5, -1000, 0});
  plate.triangles.push_back({0, n, 2 * kStrips});
  const RepairedMesh found = repair_mesh(plate);
  EXPECT_EQ(found.findings.cut_triangles, 1U);
  EXPECT_EQ(found.parts.at(0).shell_count, 1U);
  EXPECT_EQ(found.parts[0].triangles.size(), 3 * kStrips);
}

/// A fin along an edge of the solid, cut otherwise than both its faces.
TEST(TJunctions, AFinOnASolidLeavesItASolid) {
  const auto corner = [](const GridMesh& mesh, std::size_t k) {
    return mesh.vertices[mesh.triangles[0][k]];
  };
  GridMesh mesh = cube();
  const Vec3i a = corner(mesh, 0), c = corner(mesh, 1);
  split_side(mesh, 0, 0, *test::grid_point_between(a, c, 1, 3));
  const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {*test::grid_point_between(a, c, 1, 4),
                                             *test::grid_point_between(a, c, 3, 4),
                                             {-kSize, -kSize, -kSize}});
  for (const Triangle& fin : {Triangle{n, n + 1, n + 2}, Triangle{n + 1, n, n + 2}}) {
    GridMesh with = mesh;
    with.triangles.push_back(fin);
    const RepairedMesh found = repair_mesh(with);
    ASSERT_EQ(found.parts.size(), 2U);
    EXPECT_EQ(found.parts[0].kind, PartKind::solid);
    EXPECT_EQ(found.parts[0].volume, repair_mesh(cube()).parts[0].volume);
    EXPECT_EQ(found.parts[1].kind, PartKind::sheet);
  }
}

/// Solids in one mesh that share an edge which each of them cuts in its own way; where each has one
/// whole triangle there, these two match, and both are one part.
TEST(TJunctions, SolidsThatShareAnEdge) {
  for (std::uint64_t seed = 1; seed <= test::rounds(50U, 5'000U); ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    GridMesh mesh = cube();
    append(mesh, grid_box({kSize, kSize, 0}, {2 * kSize, 2 * kSize, kSize}));
    split_sides(mesh, 60, draw);
    const RepairedMesh found = repair_mesh(mesh);
    double volume = 0;
    for (const Part& part : found.parts) {
      EXPECT_EQ(part.kind, PartKind::solid);
      EXPECT_FALSE(part.flags.inverted);
      volume += part.volume;
    }
    EXPECT_EQ(volume, 2 * repair_mesh(cube()).parts[0].volume);
  }
}

TEST(TJunctions, SkinsDrawnFromBothSides) {
  for (std::uint64_t seed = 1; seed <= test::rounds(50U, 5'000U); ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const GridMesh mesh = split_cube(draw);
    // The far side cut like the near one, and not at all.
    for (const GridMesh& other : {mesh, cube()}) {
      GridMesh both = mesh, far = other;
      for (Triangle& t : far.triangles) std::swap(t[1], t[2]);
      append(both, far);
      const RepairedMesh found = repair_mesh(both);
      ASSERT_EQ(found.parts.size(), 1U);
      EXPECT_EQ(found.parts[0].kind, PartKind::solid);
      EXPECT_EQ(found.parts[0].volume, repair_mesh(cube()).parts[0].volume);
    }
  }
}

/// Whether corners lie on edges hangs on coordinates, however alike meshes hang together.
TEST(TJunctions, AreNotTakenFromMeshesThatHangTogetherAlike) {
  GridMesh exact = cube();
  const Vec3i a = exact.vertices[exact.triangles[0][0]], c = exact.vertices[exact.triangles[0][1]];
  split_side(exact, 0, 0, *test::grid_point_between(a, c, 1, 3));
  GridMesh beside = exact;
  beside.vertices.back().z += 1;
  for (const auto& [first, second] : {std::pair(&exact, &beside), std::pair(&beside, &exact)}) {
    MeshRepairer analyser;
    for (int i = 0; i < 4; ++i) (void)analyser.repair_mesh(*first);
    const RepairedMesh known = analyser.repair_mesh(*second), own = repair_mesh(*second);
    EXPECT_EQ(known.parts.at(0).kind, own.parts.at(0).kind);
    EXPECT_EQ(known.parts[0].triangles, own.parts[0].triangles);
    EXPECT_EQ(known.findings.cut_triangles, own.findings.cut_triangles);
  }
}

/// n triangles across n places of one line would need n² pieces.
TEST(TJunctions, ZigzagsAreLeftAlone) {
  constexpr std::uint32_t kSpan = 4000;
  GridMesh mesh;
  for (std::uint32_t x = 0; x < kSpan; ++x) mesh.vertices.push_back({static_cast<int>(x), 0, 0});
  for (std::uint32_t i = 0; i < kSpan / 2 - 1; ++i) {
    const auto top = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({0, static_cast<std::int32_t>(i) + 1, 1});
    if (i % 2 == 0)
      mesh.triangles.push_back({i, kSpan - 1 - i, top});
    else
      mesh.triangles.push_back({kSpan - 1 - i, i, top});
  }
  const RepairedMesh found = repair_mesh(mesh);
  EXPECT_EQ(found.findings.cut_triangles, 0U);
  EXPECT_EQ(found.parts.at(0).triangles.size(), mesh.triangles.size());
  // Other lines of the mesh are none the worse for it.
  GridMesh box = grid_box({10'000, 10'000, 10'000}, {20'000, 20'000, 20'000});
  Draw draw(1);
  split_sides(box, 20, draw);
  append(mesh, box);
  EXPECT_EQ(repair_mesh(mesh).parts.at(0).kind, PartKind::solid);
}

/// Directions and moments fill 63 bits.
TEST(TJunctions, AtTheEndsOfTheGrid) {
  constexpr std::int32_t kFar = 1 << 30;
  const GridMesh whole = grid_box({-kFar, -kFar, -kFar}, {kFar, kFar, kFar});
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    GridMesh mesh = whole;
    split_sides(mesh, 60, draw);
    expect_closed(mesh, repair_mesh(whole).parts[0]);
  }
}

}  // namespace
}  // namespace strake::geometry
