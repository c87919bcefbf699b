// SPDX-License-Identifier: Apache-2.0
// The work of a pair, in counts: these hold on any machine, where times do not.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

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

TEST(PairWorkTest, RotatedPlatesCostTheSameAtEveryGap) {
  for (const std::int32_t gap : {1001, 1500, 2000, 5000, 10000, 30000, 100000}) {
    const Subject low(turned(box_mesh({0, 0, -13000}, {10000000, 10000000, 0}), 0.1, 0.2));
    IndexedMesh mesh = box_mesh({0, 0, gap}, {10000000, 10000000, gap + 13000});
    const Subject high(turned(turned(mesh, 0.5, 0), 0.1, 0.2));
    PairWork work;
    const auto r = closest(low.treed(), high.treed(), 200000, work);
    ASSERT_TRUE(r);
    EXPECT_NEAR(r->distance, gap, 5);
    EXPECT_LE(work.triangle_pairs, 144U);
    EXPECT_LE(work.node_pairs, 64U);
    EXPECT_LE(work.exact_fallbacks, 12U);
    EXPECT_EQ(meet(low.treed(), high.treed(), work).meeting, Meeting::apart);
  }
}

TEST(PairWorkTest, ParallelFacesSettleEqualDistancesCheaply) {
  // Forty thousand pairs of triangles are exactly equally far apart.
  IndexedMesh floor, roof;
  for (std::int32_t x = 0; x < 100; ++x)
    for (std::int32_t y = 0; y < 20; ++y) {
      floor.append(testing::quad_mesh({x * 1000, y * 1000, 3 * x}, {1000, 0, 3}, {0, 1000, 0}));
      roof.append(testing::quad_mesh({x * 1000 + 300, y * 1000 + 400, 3 * x + 5000}, {1000, 0, 3},
                                     {0, 1000, 0}));
    }
  const Subject a(floor), b(roof);
  PairWork work;
  const auto r = closest(a.treed(), b.treed(), 100000, work);
  ASSERT_TRUE(r);
  EXPECT_NEAR(r->distance, 4999, 1);
  EXPECT_LE(work.exact_fallbacks, 16U);
}

TEST(PairWorkTest, ConcentricCylindersCostAFewPairsATriangle) {
  const Subject inner(cylinder(499500, 1999000, 80, 64));
  const Subject outer(cylinder(500000, 2000000, 80, 64), {0, 0, -500});
  const std::size_t triangles = inner.part.triangles.size() + outer.part.triangles.size();
  ASSERT_GT(triangles, 20000U);
  PairWork work;
  const auto r = closest(inner.treed(), outer.treed(), 1000, work);
  ASSERT_TRUE(r);
  EXPECT_GT(r->distance, 490);
  EXPECT_LE(r->distance, 500);
  EXPECT_LE(work.triangle_pairs, 10 * triangles);
  EXPECT_LE(work.node_pairs, 12 * triangles);
  // Equal distances all along the rings, in the eight directions of the symmetry.
  EXPECT_LE(work.exact_fallbacks, triangles / 4);
  PairWork meeting;
  EXPECT_EQ(meet(inner.treed(), outer.treed(), meeting).meeting, Meeting::a_inside_b);
  EXPECT_LE(meeting.triangle_pairs, 6 * triangles);
}

TEST(PairWorkTest, FlushContactNeedsFewTriangles) {
  const Subject plate(box_mesh({0, 0, -8000}, {6000000, 4000000, 0}));
  const Subject box(box_mesh({500000, 500000, 0}, {700000, 900000, 1200000}));
  PairWork work;
  EXPECT_EQ(meet(plate.treed(), box.treed(), work).meeting, Meeting::touching);
  EXPECT_LE(work.triangle_pairs, 4U);
  EXPECT_LE(work.node_pairs, 20U);
}

}  // namespace
}  // namespace strake::geometry
