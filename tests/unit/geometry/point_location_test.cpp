// SPDX-License-Identifier: Apache-2.0
// Points in bodies with faces of many needles: by the turned frame as without it, and at a cost
// that does not grow with the needles.
#include "geometry/distance/point_location.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "strake/parallel/team.hpp"
#include "support/draw.hpp"
#include "support/part_builder.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using test::Draw;
using testing::IndexedMesh;
using testing::Subject;

/// A drum whose ends fan out from their centres. Lengths in grid units.
struct Drum {
  std::uint32_t sides = 0;
  double radius = 0, low = 0, high = 0, phase = 0;
};

IndexedMesh drum_mesh(const Drum& drum, const Mat3d& turn) {
  IndexedMesh m;
  const auto add = [&](double x, double y, double z) {
    const Vec3d p = turn * Vec3d{x, y, z};
    m.vertices.push_back({static_cast<std::int32_t>(std::lround(p.x)),
                          static_cast<std::int32_t>(std::lround(p.y)),
                          static_cast<std::int32_t>(std::lround(p.z))});
  };
  for (const double z : {drum.low, drum.high})
    for (std::uint32_t i = 0; i < drum.sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / drum.sides + drum.phase;
      add(drum.radius * std::cos(angle), drum.radius * std::sin(angle), z);
    }
  add(0, 0, drum.low);
  add(0, 0, drum.high);
  const std::uint32_t n = drum.sides, low = 2 * n, high = low + 1;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    m.triangles.push_back({i, j, n + j});
    m.triangles.push_back({i, n + j, n + i});
    m.triangles.push_back({low, j, i});
    m.triangles.push_back({high, n + i, n + j});
  }
  return m;
}

void shuffle_triangles(IndexedMesh& mesh, Draw& draw) {
  for (std::size_t i = mesh.triangles.size(); i > 1; --i)
    std::swap(mesh.triangles[i - 1], mesh.triangles[draw.below(i)]);
}

TEST(PointLocator, ATurnedFrameGivesTheSamePlaces) {
  const int rounds = test::rounds(8, 200);
  std::array<int, 3> found{};
  for (int round = 0; round < rounds; ++round) {
    Draw draw(static_cast<std::uint64_t>(round));
    const Mat3d turn = draw.rotation();
    const std::uint32_t sides = 300 + static_cast<std::uint32_t>(draw.below(500));
    IndexedMesh mesh = drum_mesh({sides, 500000, -5000, 5000, 0}, turn);
    if (draw.one_in(2)) shuffle_triangles(mesh, draw);
    const Subject drum(mesh, {10, -20, 30});
    const auto frame = frame_along_faces(drum.treed(), {});
    ASSERT_TRUE(frame);
    const double band = draw.one_in(2) ? 3 : 0.5;
    // Points on the flat ends, in them and at the wall, rough by a few units, in rings and at will.
    std::vector<Vec3l> points;
    for (int i = 0; i < 1500; ++i) {
      const double angle = draw.one_in(2) ? 0.004 * i : draw.between(0, 7);
      const double r = draw.one_in(4) ? 500000 + draw.between(-8, 8) : draw.between(0, 500000);
      const double z = draw.one_in(3)   ? draw.between(-6000, 6000)
                       : draw.one_in(2) ? 5000 + draw.between(-6, 6)
                                        : -5000 + draw.between(-6, 6);
      const Vec3d p = turn * Vec3d{r * std::cos(angle), r * std::sin(angle), z};
      points.push_back({std::llround(p.x), std::llround(p.y), std::llround(p.z)});
    }
    PointLocator plain(drum.treed(), band, nullptr), turned(drum.treed(), band, &*frame);
    QueryContext work;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const BandLocation location = plain.location(points[i], work);
      ++found[static_cast<std::size_t>(location)];
      ASSERT_EQ(turned.location(points[i], work), location) << "round " << round << ", point " << i;
      const double apart = distance_to_surface(drum.treed(), points[i].as<double>());
      ASSERT_EQ(location == BandLocation::near_surface, apart <= band);
    }
  }
  for (const int times : found) EXPECT_GT(times, 100 * rounds);
}

/// The work of finding a drum, flush with another at one end, in that.
QueryContext work_of_flush_drums(std::uint32_t sides, bool shuffled) {
  Draw draw(sides);
  const Mat3d turn = draw.rotation();
  IndexedMesh around = drum_mesh({sides, 500000, 0, 10000, 0}, turn);
  if (shuffled) shuffle_triangles(around, draw);
  const Subject a(drum_mesh({sides, 400000, 0, 6000, 1.0 / sides}, turn)), b(around);
  QueryContext work;
  const ToleranceContainment cover = containment_within(a.treed(), b.treed(), 3, work);
  EXPECT_TRUE(cover.within);
  EXPECT_FALSE(cover.on_surface);
  return work;
}

TEST(PointLocator, NeedlesOfAFlushFaceCostEachVertexLittle) {
  for (const bool shuffled : {false, true})
    for (const std::uint32_t sides : {1000U, 8000U})
      EXPECT_LE(work_of_flush_drums(sides, shuffled).node_pairs, 400 * sides) << sides;
}

TEST(PointLocator, AVertexOutsideIsFoundAmongInsideOnes) {
  const Mat3d turn = Draw(7).rotation();
  const Subject b(drum_mesh({2000, 500000, 0, 10000, 0}, turn));
  IndexedMesh mesh = drum_mesh({2000, 400000, 0, 6000, 0.0003}, turn);
  QueryContext work;
  EXPECT_TRUE(containment_within(Subject(mesh).treed(), b.treed(), 3, work).within);
  const Vec3d p = turn * Vec3d{400000, 0, -10};
  mesh.vertices[3] = {static_cast<std::int32_t>(std::lround(p.x)),
                      static_cast<std::int32_t>(std::lround(p.y)),
                      static_cast<std::int32_t>(std::lround(p.z))};
  EXPECT_FALSE(containment_within(Subject(mesh).treed(), b.treed(), 3, work).within);
}

TEST(PointLocator, ATeamFindsTheSameAtTheSameCost) {
  const Mat3d turn = Draw(9).rotation();
  const Subject b(drum_mesh({3000, 500000, 0, 10000, 0}, turn));
  const Subject a(drum_mesh({35000, 400000, 0, 6000, 0.0003}, turn));
  QueryContext alone;
  const ToleranceContainment cover = containment_within(a.treed(), b.treed(), 3, alone);
  EXPECT_TRUE(cover.within);
  for (const unsigned threads : {2U, 3U, 8U}) {
    parallel::Team team(threads);
    const parallel::Context context{.team = &team};
    QueryContext work;
    work.team = &context;
    EXPECT_EQ(containment_within(a.treed(), b.treed(), 3, work).within, cover.within);
    EXPECT_EQ(work.node_pairs, alone.node_pairs) << threads;
  }
}

}  // namespace
}  // namespace strake::geometry
