// SPDX-License-Identifier: Apache-2.0
// Depth where skin caves in, and between bodies that fall into blocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "../../support/nonconvex_bodies.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

using testing::beam;
using testing::crosswise;
using testing::cylinder;
using testing::depth_at;
using testing::depth_from_touch;
using testing::depth_of;
using testing::IndexedMesh;
using testing::interiors_meet;
using testing::Subject;
using testing::tube;
using testing::turned;

/// Fitting bolts: hole and bolt have one radius, their tessellations another number of sides, so
/// that corners of the bolt stand in the facets of the hole. That it is no more is certain.
TEST(ConcaveDepth, AFittingBoltIsNoDeeperThanTheFacets) {
  for (const int hole_sides : {12, 24, 40})
    for (const int bolt_sides : {16, 30})
      for (const bool askew : {false, true}) {
        constexpr double kRadius = 10'000;
        IndexedMesh plate = tube(hole_sides, 3 * kRadius, kRadius, 0, 15'000);
        IndexedMesh bolt = cylinder(bolt_sides, kRadius, -20'000, 30'000);
        if (askew) {
          plate = turned(plate);
          bolt = turned(bolt);
        }
        const Subject a(plate), b(bolt);
        ASSERT_TRUE(interiors_meet(a, b));
        const Depth d = depth_from_touch(a, b, {.threshold = 1000});
        const double sag = kRadius * (1 - std::cos(std::numbers::pi / hole_sides));
        EXPECT_LE(d.value, sag + 2);
        EXPECT_LE(d.upper, 1000) << hole_sides << " and " << bolt_sides << (askew ? " askew" : "");
      }
}

/// Tubes pushed over each other: what is common is a shell that is long, wide and thin.
TEST(ConcaveDepth, ASpigotIsNoDeeperThanItsWall) {
  const Subject a(tube(24, 54'000, 50'000, 0, 200'000));
  const Subject b(tube(32, 52'000, 46'000, -100'000, 60'000));
  const Depth d = depth_of(a, b, {.threshold = 1000});
  // 4 mm of wall from 50 to 52, 4 to 6 mm of the other; sags of no more than half a millimetre.
  EXPECT_GE(d.lower, 1'500);
  EXPECT_LE(d.upper, 6'500);
}

/// Beams that cross squarely fall into a few blocks, however the two stand in the world.
TEST(ConcaveDepth, CrossingBeamsTakeFewCells) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](std::int32_t lo, std::int32_t hi) {
      return lo + static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(hi - lo));
    };
    const std::int32_t width = draw(60'000, 140'000), height = draw(100'000, 300'000);
    const std::int32_t flange = draw(7'000, 15'000), web = draw(5'000, 9'000);
    const IndexedMesh along = beam(3'000'000, 100'000, 200'000, 8'500, 5'600);
    IndexedMesh other = crosswise(beam(2'000'000, width, height, flange, web));
    const std::int32_t x = draw(200'000, 2'800'000), y = draw(-1'500'000, -300'000);
    const std::int32_t z = draw(-height + 20'000, 150'000);
    for (Vec3i& v : other.vertices) v = v + Vec3i{x, y, z};
    const bool askew = seed % 2 == 0;
    const Subject a(askew ? turned(along) : along), b(askew ? turned(other) : other);
    ASSERT_TRUE(interiors_meet(a, b)) << "seed " << seed;
    const Depth d = depth_from_touch(a, b, {.threshold = 1000});
    EXPECT_LE(d.upper - d.lower, 0.0201 * d.upper) << "seed " << seed;
    EXPECT_LT(d.cells, 500U) << "seed " << seed;
    for (int i = 0; i < 4000; ++i) {
      const std::int32_t reach = i % 2 == 0 ? 120'000 : 4'000;
      const std::int32_t dx = draw(-reach, reach), dy = draw(-reach, reach);
      const Vec3l q{std::llround(d.point.x) + dx, std::llround(d.point.y) + dy,
                    std::llround(d.point.z) + draw(-reach, reach)};
      ASSERT_LE(depth_at(a, b, q), d.upper + 1e-3) << "seed " << seed;
    }
  }
}

/// No sample round the edges of holes is deeper, where a roof of many planes bounds what is below
/// it.
TEST(ConcaveDepth, NoSampleInAHoleIsDeeperThanTheBracket) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](double lo, double hi) {
      return lo + (hi - lo) * static_cast<double>(random() >> 11U) * 0x1p-53;
    };
    const int sides = static_cast<int>(draw(5, 30)), other = static_cast<int>(draw(5, 30));
    const double radius = draw(2'000, 9'000), tighter = radius * draw(0.9, 1.1);
    const auto x = static_cast<std::int32_t>(draw(-900, 900));
    const auto z = static_cast<std::int32_t>(draw(-9'000, 0));
    const bool askew = seed % 2 == 0;
    const IndexedMesh ring = tube(sides, radius + draw(500, 9'000), radius, 0, 6'000);
    IndexedMesh pin = seed % 3 == 0 ? tube(other, tighter, tighter * draw(0.4, 0.95), -3'000, 4'000)
                                    : cylinder(other, tighter, -3'000, 4'000);
    for (Vec3i& v : pin.vertices) v = v + Vec3i{x, 300, z / 4};
    const Subject a(askew ? turned(ring) : ring), b(askew ? turned(pin) : pin);
    if (!interiors_meet(a, b)) continue;
    const Depth d = depth_of(a, b, {.threshold = 100, .tolerance = 1, .relative = 1e-4});
    EXPECT_LE(d.lower, d.upper);
    for (int i = 0; i < 2000; ++i) {
      const double reach = std::pow(10, draw(0, 4));
      Vec3d p = d.point;
      if (i % 2 == 0) p = b.part.vertices[random() % b.part.vertices.size()].as<double>();
      const double dx = draw(-reach, reach), dy = draw(-reach, reach), dz = draw(-reach, reach);
      const Vec3l q{std::llround(p.x + dx), std::llround(p.y + dy), std::llround(p.z + dz)};
      ASSERT_LE(depth_at(a, b, q), d.upper + 1e-3) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace strake::geometry
