// SPDX-License-Identifier: Apache-2.0
// Seams that the numbers of a source leave open close; rims, holes and thin skins stay as they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/near_vertices.hpp"
#include "support/draw.hpp"
#include "support/grid_bodies.hpp"
#include "support/rounds.hpp"
#include "support/slivers.hpp"

namespace strake::geometry {
namespace {

using test::Draw;
using test::grid_box;

constexpr std::int64_t kWeld = 3;

std::size_t count(const RepairedMesh& found, PartKind kind) {
  return static_cast<std::size_t>(
      std::ranges::count_if(found.parts, [&](const Part& part) { return part.kind == kind; }));
}

void expect_same(const RepairedMesh& a, const RepairedMesh& b, const Vec3i& moved = {}) {
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    const Part &p = a.parts[i], &q = b.parts[i];
    EXPECT_EQ(p.kind, q.kind);
    EXPECT_EQ(p.triangles, q.triangles);
    EXPECT_EQ(p.volume, q.volume);
    ASSERT_EQ(p.vertices.size(), q.vertices.size());
    for (std::size_t v = 0; v < p.vertices.size(); ++v)
      EXPECT_EQ(p.vertices[v] + moved, q.vertices[v]);
  }
  EXPECT_EQ(a.findings.welded_corners, b.findings.welded_corners);
  EXPECT_EQ(a.findings.welded_shells, b.findings.welded_shells);
  EXPECT_EQ(a.findings.largest_weld, b.findings.largest_weld);
}

/// What lies as it came, whether seams may close or not.
void expect_left_alone(const GridMesh& mesh, std::int64_t weld = kWeld) {
  const RepairedMesh exact = repair_mesh(mesh), found = repair_mesh(mesh, {weld});
  expect_same(exact, found);
  EXPECT_EQ(found.findings.welded_corners, 0U);
}

/// The mesh without some of its triangles.
GridMesh without(GridMesh mesh, const std::vector<std::size_t>& left_out) {
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (std::ranges::find(left_out, t) == left_out.end()) kept.push_back(mesh.triangles[t]);
  mesh.triangles = std::move(kept);
  return mesh;
}

/// A box of this size whose lid, the last face that grid_box() makes at the top, stands `by` off.
GridMesh lid_off(const Vec3i& size, const Vec3i& by) {
  GridMesh mesh = grid_box({0, 0, 0}, size);
  const auto is_lid = [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return mesh.vertices[v].z == size.z; });
  };
  for (Triangle& t : mesh.triangles) {
    if (!is_lid(t)) continue;
    for (std::uint32_t& v : t) {
      const Vec3i at = mesh.vertices[v] + by;
      v = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(at);
    }
  }
  return mesh;
}

TEST(ToleranceWeld, ALidThatStandsOff) {
  for (const Vec3i& by :
       {Vec3i{0, 0, 1}, Vec3i{0, 0, 3}, Vec3i{0, 0, -2}, Vec3i{1, 1, 1}, Vec3i{2, 0, 2}}) {
    const GridMesh mesh = lid_off({500'000, 300'000, 200'000}, by);
    EXPECT_EQ(count(repair_mesh(mesh), PartKind::sheet), 1U);
    const RepairedMesh found = repair_mesh(mesh, {kWeld});
    ASSERT_EQ(found.parts.size(), 1U);
    EXPECT_EQ(found.parts[0].kind, PartKind::solid);
    EXPECT_EQ(found.parts[0].vertices.size(), 8U);
    EXPECT_EQ(found.findings.welded_corners, 4U);
    EXPECT_EQ(found.findings.welded_shells, 1U);
    EXPECT_GE(found.findings.largest_weld, 1);
    EXPECT_LE(found.findings.largest_weld, kWeld);
  }
}

TEST(ToleranceWeld, AWiderGapStaysOpen) {
  for (const Vec3i& by : {Vec3i{0, 0, 4}, Vec3i{0, 0, 9}, Vec3i{3, 3, 3}, Vec3i{-4, 0, 4}})
    expect_left_alone(lid_off({500'000, 300'000, 200'000}, by));
}

TEST(ToleranceWeld, NoLidNoSolid) {
  const GridMesh box = grid_box({0, 0, 0}, {500'000, 300'000, 200'000});
  for (std::size_t t = 0; t < box.triangles.size(); ++t) {
    expect_left_alone(without(box, {t}));
    expect_left_alone(without(box, {t, (t + 1) % box.triangles.size()}));
  }
}

TEST(ToleranceWeld, APlateKeepsItsRim) {
  GridMesh plate;
  plate.vertices = {{0, 0, 0}, {1000, 0, 0}, {1000, 1000, 0}, {0, 1000, 0}, {2, 500, 0}};
  plate.triangles = {{0, 1, 2}, {0, 2, 4}, {4, 2, 3}};
  expect_left_alone(plate);
}

// A hole that is as small as its corners may lie apart has nothing that would meet.
TEST(ToleranceWeld, ASmallHoleStays) {
  GridMesh mesh = grid_box({0, 0, 0}, {500'000, 300'000, 200'000});
  const Triangle t = mesh.triangles[0];
  const auto inner = static_cast<std::uint32_t>(mesh.vertices.size());
  const Vec3l sum = mesh.vertices[t[0]].as<std::int64_t>() +
                    mesh.vertices[t[1]].as<std::int64_t>() + mesh.vertices[t[2]].as<std::int64_t>();
  const Vec3i middle = Vec3l{sum.x / 3, sum.y / 3, sum.z / 3}.as<std::int32_t>();
  const auto towards = [&](std::uint32_t v) {
    Vec3i step;
    for (int k = 0; k < 3; ++k) {
      const auto way = mesh.vertices[v][k] - middle[k];
      step[k] = way > 0 ? 1 : way < 0 ? -1 : 0;
    }
    return middle + step;
  };
  const std::vector<Vec3i> ring{towards(t[0]), towards(t[1]), towards(t[2])};
  mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
  mesh.triangles.erase(mesh.triangles.begin());
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t j = (i + 1) % 3;
    mesh.triangles.push_back({t[i], t[j], inner + j});
    mesh.triangles.push_back({t[i], inner + j, inner + i});
  }
  expect_left_alone(mesh);
}

// Two skins back to back, nearer than corners that count as one: closed, they would be a solid of
// nothing.
TEST(ToleranceWeld, TwoSkinsBackToBackStay) {
  for (const std::int32_t apart : {1, 2, 3}) {
    GridMesh skins;
    for (const std::int32_t z : {0, apart})
      for (std::int32_t x = 0; x <= 4; ++x)
        for (std::int32_t y = 0; y <= 4; ++y) skins.vertices.push_back({x * 1000, y * 1000, z});
    for (std::uint32_t side = 0; side < 2; ++side)
      for (std::uint32_t x = 0; x < 4; ++x)
        for (std::uint32_t y = 0; y < 4; ++y) {
          const std::uint32_t a = side * 25 + x * 5 + y, b = a + 5, c = a + 6, d = a + 1;
          const bool up = side == 1;
          skins.triangles.push_back(up ? Triangle{a, b, c} : Triangle{a, c, b});
          skins.triangles.push_back(up ? Triangle{a, c, d} : Triangle{a, d, c});
        }
    expect_left_alone(skins);
  }
}

// The corners of a finer rim than that are a chain, of which none is the middle.
TEST(ToleranceWeld, AFineRimIsAChain) {
  GridMesh strip;
  for (std::int32_t i = 0; i <= 200; ++i)
    for (const std::int32_t y : {0, 50'000}) strip.vertices.push_back({2 * i, y, 0});
  for (std::uint32_t i = 0; i < 200; ++i) {
    strip.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    strip.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  expect_left_alone(strip);
}

/// A stair of quads as soup, each corner moved along each axis by -1, 0 or 1.
GridMesh jittered(const GridMesh& mesh, Draw& draw) {
  GridMesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t v : t)
      soup.vertices.push_back(mesh.vertices[v] +
                              Vec3i{draw.whole(-1, 2), draw.whole(-1, 2), draw.whole(-1, 2)});
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TEST(ToleranceWeld, SoupIsTheSolidWhateverItsOrderAndPlace) {
  constexpr std::int64_t kWide = 4;  // more than the diagonal of two steps
  for (std::uint64_t seed = 1; seed <= test::rounds(50U, 5'000U); ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const GridMesh stair = test::grid_stair(90'000);
    GridMesh soup = jittered(stair, draw);
    const RepairedMesh found = repair_mesh(soup, {kWide}), clean = repair_mesh(stair);
    ASSERT_EQ(found.parts.size(), 1U);
    EXPECT_EQ(found.parts[0].kind, PartKind::solid);
    EXPECT_EQ(found.parts[0].triangles.size(), clean.parts[0].triangles.size());
    EXPECT_EQ(found.findings.welded_shells, 1U);
    EXPECT_NEAR(found.parts[0].volume, clean.parts[0].volume, 2 * clean.parts[0].area);
    const Vec3i by{draw.whole(-1000, 1000), draw.whole(-1000, 1000), draw.whole(-1000, 1000)};
    GridMesh moved = soup;
    for (Vec3i& v : moved.vertices) v = v + by;
    expect_same(found, repair_mesh(moved, {kWide}), by);
    for (std::size_t i = soup.triangles.size(); i > 1; --i)
      std::swap(soup.triangles[i - 1], soup.triangles[draw.below(i)]);
    for (Triangle& t : soup.triangles)
      std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(draw.below(3)), t.end());
    expect_same(found, repair_mesh(soup, {kWide}));
  }
}

// A corner that the snap has taken off the edge that it stood on.
TEST(ToleranceWeld, ACornerBesideAnEdge) {
  for (std::uint64_t seed = 1; seed <= test::rounds(200U, 20'000U); ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    GridMesh mesh = grid_box({0, 0, 0}, {700'000, 500'000, 300'000});
    const Mat3d turn = draw.rotation();
    for (int i = 0; i < 6; ++i) {
      const auto number = static_cast<std::size_t>(draw.below(mesh.triangles.size()));
      const auto side = static_cast<std::size_t>(draw.below(3));
      const Triangle t = mesh.triangles[number];
      const Vec3d a = mesh.vertices[t[side]].as<double>(),
                  c = mesh.vertices[t[(side + 1) % 3]].as<double>();
      const auto b = static_cast<std::uint32_t>(mesh.vertices.size());
      const Vec3d at = a + (c - a) * draw.between(0.1, 0.9);
      mesh.vertices.push_back(
          Vec3d{std::round(at.x), std::round(at.y), std::round(at.z)}.as<std::int32_t>());
      mesh.triangles[number] = {t[side], b, t[(side + 2) % 3]};
      mesh.triangles.push_back({b, t[(side + 1) % 3], t[(side + 2) % 3]});
    }
    for (Vec3i& v : mesh.vertices) {
      const Vec3d at = turn * v.as<double>();
      v = Vec3d{std::round(at.x), std::round(at.y), std::round(at.z)}.as<std::int32_t>();
    }
    const RepairedMesh found = repair_mesh(mesh, {kWeld});
    ASSERT_EQ(found.parts.size(), 1U);
    EXPECT_EQ(found.parts[0].kind, PartKind::solid);
    EXPECT_EQ(found.parts[0].shell_count, 1U);
    EXPECT_NEAR(found.parts[0].volume, 700e3 * 500e3 * 300e3, 3 * found.parts[0].area);
  }
}

// What hangs together like a mesh that is open may lie so that it closes.
TEST(ToleranceWeld, MeshesThatHangTogetherAlike) {
  MeshRepairer analyser;
  const GridMesh apart = lid_off({500'000, 300'000, 200'000}, {0, 0, 40});
  const GridMesh near = lid_off({500'000, 300'000, 200'000}, {0, 0, 2});
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(count(analyser.repair_mesh(apart, {kWeld}), PartKind::sheet), 1U);
    EXPECT_EQ(count(analyser.repair_mesh(near, {kWeld}), PartKind::solid), 1U);
    EXPECT_EQ(count(analyser.repair_mesh(near, {0}), PartKind::sheet), 1U);
  }
}

TEST(NearPoints, AreThoseThatALookAtAllFinds) {
  Draw draw(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec3i> points;
    const std::int32_t size = round % 2 == 0 ? 30 : 1'000'000'000;
    for (int i = 0; i < 300; ++i)
      points.push_back({draw.whole(-size, size), draw.whole(-size, size), draw.whole(-size, size)});
    std::vector<std::uint32_t> all(points.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    const NearPoints tree(points, all);
    const Vec3i &a = points[draw.below(300)], &b = points[draw.below(300)];
    const std::int64_t within = round % 2 == 0 ? draw.whole(0, 12) : draw.whole(0, kMaxWeld);
    std::vector<std::uint32_t> found, right;
    std::uint64_t boxes = NearPoints::boxes_for(1);
    EXPECT_TRUE(tree.near(a, b, within, boxes, found));
    std::sort(found.begin(), found.end());
    for (const std::uint32_t i : all)
      if (is_near_segment(points[i], a, b, within)) right.push_back(i);
    EXPECT_EQ(found, right);
    EXPECT_GE(right.size(), 1U);
  }
}

}  // namespace
}  // namespace strake::geometry
