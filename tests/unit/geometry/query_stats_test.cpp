// SPDX-License-Identifier: Apache-2.0
// The work of a pair, in counts: these hold on any machine, where times do not.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "strake/geometry/part_pair.hpp"
#include "support/part_builder.hpp"

namespace strake::geometry {
namespace {

using testing::box_mesh;
using testing::IndexedMesh;
using testing::Subject;

IndexedMesh turned(IndexedMesh mesh, double angle, double tilt) {
  for (Vec3i& v : mesh.vertices) {
    const Vec3d p = v.as<double>();
    const Vec3d q{p.x * std::cos(angle) - p.y * std::sin(angle),
                  p.x * std::sin(angle) + p.y * std::cos(angle), p.z};
    v = {static_cast<std::int32_t>(std::lround(q.x)),
         static_cast<std::int32_t>(std::lround(q.y * std::cos(tilt) - q.z * std::sin(tilt))),
         static_cast<std::int32_t>(std::lround(q.y * std::sin(tilt) + q.z * std::cos(tilt)))};
  }
  return mesh;
}

/// A cylinder round z from 0 to `height`, `sectors` round and `rings` along, with flat ends.
IndexedMesh cylinder(double radius, std::int32_t height, std::uint32_t sectors,
                     std::uint32_t rings) {
  IndexedMesh m;
  for (std::uint32_t r = 0; r <= rings; ++r)
    for (std::uint32_t s = 0; s < sectors; ++s) {
      const double angle = 2 * std::numbers::pi * s / sectors;
      m.vertices.push_back({static_cast<std::int32_t>(std::lround(radius * std::cos(angle))),
                            static_cast<std::int32_t>(std::lround(radius * std::sin(angle))),
                            static_cast<std::int32_t>(std::int64_t{height} * r / rings)});
    }
  const std::uint32_t low = static_cast<std::uint32_t>(m.vertices.size()), high = low + 1;
  m.vertices.push_back({0, 0, 0});
  m.vertices.push_back({0, 0, height});
  for (std::uint32_t s = 0; s < sectors; ++s) {
    const std::uint32_t n = (s + 1) % sectors, top = rings * sectors;
    m.triangles.push_back({low, n, s});
    m.triangles.push_back({high, top + s, top + n});
    for (std::uint32_t r = 0; r < rings; ++r) {
      const std::uint32_t base = r * sectors;
      m.triangles.push_back({base + s, base + n, base + sectors + n});
      m.triangles.push_back({base + s, base + sectors + n, base + sectors + s});
    }
  }
  return m;
}

TEST(QueryStatsTest, RotatedPlatesCostTheSameAtEveryGap) {
  for (const std::int32_t gap : {1001, 1500, 2000, 5000, 10000, 30000, 100000}) {
    const Subject low(turned(box_mesh({0, 0, -13000}, {10000000, 10000000, 0}), 0.1, 0.2));
    const IndexedMesh mesh = box_mesh({0, 0, gap}, {10000000, 10000000, gap + 13000});
    const Subject high(turned(turned(mesh, 0.5, 0), 0.1, 0.2));
    QueryContext work;
    const auto r = find_closest_pair(low.treed(), high.treed(), 200000, work);
    ASSERT_TRUE(r);
    EXPECT_NEAR(r->distance, gap, 5);
    EXPECT_LE(work.triangle_pairs, 144U);
    EXPECT_LE(work.node_pairs, 64U);
    EXPECT_LE(work.exact_fallbacks, 12U);
    EXPECT_EQ(meet(low.treed(), high.treed(), work).meeting, Meeting::apart);
  }
}

TEST(QueryStatsTest, ParallelFacesSettleEqualDistancesCheaply) {
  // Forty thousand pairs of triangles are exactly equally far apart.
  IndexedMesh floor, roof;
  for (std::int32_t x = 0; x < 100; ++x)
    for (std::int32_t y = 0; y < 20; ++y) {
      floor.append(testing::quad_mesh({x * 1000, y * 1000, 3 * x}, {1000, 0, 3}, {0, 1000, 0}));
      roof.append(testing::quad_mesh({x * 1000 + 300, y * 1000 + 400, 3 * x + 5000}, {1000, 0, 3},
                                     {0, 1000, 0}));
    }
  const Subject a(floor), b(roof);
  QueryContext work;
  const auto r = find_closest_pair(a.treed(), b.treed(), 100000, work);
  ASSERT_TRUE(r);
  EXPECT_NEAR(r->distance, 4999, 1);
  EXPECT_LE(work.exact_fallbacks, 16U);
}

TEST(QueryStatsTest, ConcentricCylindersCostAFewPairsATriangle) {
  const Subject inner(cylinder(499500, 1999000, 80, 64));
  const Subject outer(cylinder(500000, 2000000, 80, 64), {0, 0, -500});
  const std::size_t triangles = inner.part.triangles.size() + outer.part.triangles.size();
  ASSERT_GT(triangles, 20000U);
  QueryContext work;
  const auto r = find_closest_pair(inner.treed(), outer.treed(), 1000, work);
  ASSERT_TRUE(r);
  EXPECT_GT(r->distance, 490);
  EXPECT_LE(r->distance, 500);
  EXPECT_LE(work.triangle_pairs, 10 * triangles);
  EXPECT_LE(work.node_pairs, 12 * triangles);
  // Equal distances all along the rings, in the eight directions of the symmetry.
  EXPECT_LE(work.exact_fallbacks, triangles / 4);
  QueryContext meeting;
  EXPECT_EQ(meet(inner.treed(), outer.treed(), meeting).meeting, Meeting::a_inside_b);
  EXPECT_LE(meeting.triangle_pairs, 6 * triangles);
}

TEST(QueryStatsTest, FlushContactNeedsFewTriangles) {
  const Subject plate(box_mesh({0, 0, -8000}, {6000000, 4000000, 0}));
  const Subject box(box_mesh({500000, 500000, 0}, {700000, 900000, 1200000}));
  QueryContext work;
  EXPECT_EQ(meet(plate.treed(), box.treed(), work).meeting, Meeting::touching);
  EXPECT_LE(work.triangle_pairs, 4U);
  EXPECT_LE(work.node_pairs, 20U);
}

// Caps that are fans of needles from their centre, as most programs write them.

struct FanPair {
  const char* name;
  IndexedMesh a, b;
  Vec3i shift;      ///< of b
  double distance;  ///< of the skins
  Meeting meeting;
};

IndexedMesh moved(IndexedMesh mesh, const Vec3i& by) {
  for (Vec3i& v : mesh.vertices) v = v + by;
  return mesh;
}

/// A disc with a flat recess, into which others fit without a plane between.
IndexedMesh recessed(double radius, std::int32_t height, double recess, std::int32_t floor,
                     std::uint32_t sectors) {
  IndexedMesh m = cylinder(radius, height, sectors, 1);
  // Its upper cap makes way for a rim, a wall and a floor.
  std::erase_if(m.triangles, [&](const Triangle& t) { return t[0] == 2 * sectors + 1; });
  IndexedMesh hole = cylinder(recess, height - floor, sectors, 1);
  std::erase_if(hole.triangles, [&](const Triangle& t) { return t[0] == 2 * sectors + 1; });
  const auto first = static_cast<std::uint32_t>(m.vertices.size());
  m.append(moved(hole, {0, 0, floor}).flipped());
  for (std::uint32_t s = 0; s < sectors; ++s) {
    const std::uint32_t n = (s + 1) % sectors, out = sectors, in = first + sectors;
    m.triangles.push_back({out + s, out + n, in + n});
    m.triangles.push_back({out + s, in + n, in + s});
  }
  return m;
}

std::vector<FanPair> fan_pairs(std::uint32_t sectors) {
  const auto disc = [&](double radius, std::int32_t height) {
    return turned(cylinder(radius, height, sectors, 1), 1.0 / sectors, 0);
  };
  const IndexedMesh plate = cylinder(500000, 10000, sectors, 1);
  return {
      {"gap", plate, disc(500000, 10000), {0, 0, 10500}, 500, Meeting::apart},
      {"gap to a smaller one", plate, disc(300000, 10000), {0, 0, 10500}, 500, Meeting::apart},
      {"nested", plate, disc(400000, 6000), {0, 0, 2000}, 2000, Meeting::b_inside_a},
      // Needles that cross each other, and nearly all of whose boxes meet.
      {"gap aside", plate, disc(400000, 10000), {150000, 170000, 10500}, 500, Meeting::apart},
      {"gap at the rims", plate, disc(500000, 10000), {600000, 700000, 10500}, 500, Meeting::apart},
      {"in a recess",
       recessed(600000, 40000, 500000, 10000, sectors),
       disc(499000, 10000),
       {0, 0, 10500},
       500,
       Meeting::apart}};
}

TEST(QueryStatsTest, FansOfNeedlesCostAFewPairsATriangle) {
  for (const std::uint32_t sectors : {100U, 1000U, 4000U})
    for (const FanPair& pair : fan_pairs(sectors))
      for (const bool askew : {false, true}) {
        SCOPED_TRACE(std::string(pair.name) + ", " + std::to_string(sectors) +
                     (askew ? " sides, turned" : " sides"));
        const auto stand = [&](const IndexedMesh& m) { return askew ? turned(m, 0.4, 0.7) : m; };
        const Subject a(stand(pair.a)), b(stand(moved(pair.b, pair.shift)));
        const std::size_t triangles = a.part.triangles.size() + b.part.triangles.size();
        QueryContext work;
        const auto r = find_closest_pair(a.treed(), b.treed(), 5000, work, askew ? 4 : 0);
        ASSERT_TRUE(r);
        EXPECT_NEAR(r->distance, pair.distance, askew ? 4 : 0.001);
        EXPECT_LE(r->lower, r->distance);
        EXPECT_GE(r->lower, r->distance - (askew ? 4 : 0));
        EXPECT_LE(work.triangle_pairs, 30 * triangles);
        EXPECT_LE(work.node_pairs, 20 * triangles);
        EXPECT_LE(work.exact_fallbacks, triangles / 4);
        QueryContext meeting;
        EXPECT_EQ(meet(a.treed(), b.treed(), meeting).meeting, pair.meeting);
        EXPECT_LE(meeting.triangle_pairs, 30 * triangles);
        EXPECT_LE(meeting.node_pairs, 20 * triangles);
      }
}

TEST(QueryStatsTest, TurnedFansAreAsFarApartAsAllTheirTriangles) {
  for (const FanPair& pair : fan_pairs(300)) {
    SCOPED_TRACE(pair.name);
    const Subject a(turned(pair.a, 0.4, 0.7)), b(turned(moved(pair.b, pair.shift), 0.4, 0.7));
    QueryContext work;
    const auto exact = find_closest_pair(a.treed(), b.treed(), 5000, work);
    const auto quick = find_closest_pair(a.treed(), b.treed(), 5000, work, 4);
    ASSERT_TRUE(exact && quick);
    EXPECT_EQ(exact->lower, exact->distance);
    EXPECT_LE(quick->lower, exact->distance);
    EXPECT_GE(quick->distance, exact->distance);
    EXPECT_LE(quick->distance, exact->distance + 4);
  }
}

TEST(QueryStatsTest, NeedlesThatTheSnapHasTurnedMakeAFlatFace) {
  // Thirty units wide at the rim: two units more or less turn one by degrees.
  const IndexedMesh plate = cylinder(20000, 3000, 4096, 1);
  for (const Vec3i& at : {Vec3i{0, 0, 3200}, Vec3i{5000, 9000, 3200}}) {
    const Subject a(turned(plate, 0.4, 0.7)), b(turned(moved(plate, at), 0.4, 0.7));
    const std::size_t triangles = a.part.triangles.size() + b.part.triangles.size();
    QueryContext work;
    const auto r = find_closest_pair(a.treed(), b.treed(), 5000, work, 4);
    ASSERT_TRUE(r);
    EXPECT_LE(r->lower, 200 + 2);
    EXPECT_GE(r->distance, 200 - 2);
    EXPECT_LE(r->distance - r->lower, 4);
    EXPECT_LE(work.triangle_pairs, 30 * triangles);
    EXPECT_LE(work.node_pairs, 20 * triangles);
  }
}

TEST(QueryStatsTest, AnyNeedlesWithinReachAreFoundSoon) {
  for (const Vec3i& at : {Vec3i{0, 0, 10002}, Vec3i{150000, 170000, 10002}}) {
    const IndexedMesh plate = cylinder(500000, 10000, 4096, 1);
    const Subject a(turned(plate, 0.4, 0.7)), b(turned(moved(plate, at), 0.4, 0.7));
    const std::size_t triangles = a.part.triangles.size() + b.part.triangles.size();
    QueryContext work;
    const auto near = find_pair_within(a.treed(), b.treed(), 4, work);
    ASSERT_TRUE(near);
    EXPECT_LE(near->distance, 4);
    const auto exact = find_closest_pair(a.treed(), b.treed(), 5, work, 4);
    ASSERT_TRUE(exact);
    EXPECT_GE(near->distance, exact->lower);
    // Nothing is found where nothing is.
    const Subject far(turned(moved(plate, at + Vec3i{0, 0, 200}), 0.4, 0.7));
    EXPECT_FALSE(find_pair_within(a.treed(), far.treed(), 4, work));
    EXPECT_LE(work.triangle_pairs, 90 * triangles);
    EXPECT_LE(work.node_pairs, 60 * triangles);
  }
}

}  // namespace
}  // namespace strake::geometry
