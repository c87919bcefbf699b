// SPDX-License-Identifier: Apache-2.0
// Solids that all but touch, parted by moves of their corners.
#include "geometry/interior_depth/bounds/separating_displacement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "../../support/draw.hpp"
#include "../../support/nonconvex_bodies.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

using test::Draw;
using testing::beam;
using testing::box_mesh;
using testing::channel;
using testing::depth_at;
using testing::depth_from_touch;
using testing::IndexedMesh;
using testing::interiors_meet;
using testing::Subject;
using testing::turned_by;

constexpr double kMax = 3;
constexpr std::int32_t kChannelLength = 1'000'000, kChannelWidth = 120'000,
                       kChannelHeight = 110'000, kChannelWall = 10'000;

/// Fills a channel from `from` to `to`, and goes into its walls and its floor by `over`.
IndexedMesh filling(std::int32_t from, std::int32_t to, std::int32_t over) {
  return box_mesh({from, kChannelWall - over, kChannelWall - over},
                  {to, kChannelWidth - kChannelWall + over, kChannelHeight});
}

std::optional<SeparatingDisplacement> shrunk(const Subject& a, const Subject& b,
                                             double most = kMax) {
  QueryContext work;
  return find_separating_displacement(a.treed(), b.treed(), most, most, work);
}

/// No point of the grid round the corners of either is deeper than what was proved.
void expect_none_deeper(const Subject& a, const Subject& b, double depth, std::uint64_t seed) {
  Draw draws(seed + 1000);
  for (const Subject* s : {&a, &b}) {
    const auto& corners = s->part.vertices;
    const auto n = static_cast<std::int32_t>(corners.size());
    for (int i = 0; i < 400; ++i) {
      // Corners, edges and what lies between them, a little to all sides.
      const auto draw = [&] {
        return corners[static_cast<std::size_t>(draws.whole(0, n))].as<double>();
      };
      const Vec3d p = draw(), q = draw();
      Vec3d at = p + (q - p) * (i % 2 == 0 ? 0 : draws.between(0, 1));
      for (int k = 0; k < 3; ++k) at[k] += draws.between(-6, 6);
      const Vec3l x{std::llround(at.x), std::llround(at.y), std::llround(at.z)};
      ASSERT_LE(depth_at(a, b, x + s->origin), depth + 1e-6) << "seed " << seed;
    }
  }
}

/// Flush on three sides, in space: nothing convex says that it is a touch, and no one move parts
/// the two.
TEST(SeparatingDisplacementTest, ABoxThatFillsAChannelIsATie) {
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Mat3d turn = Draw(seed).rotation();
    const Subject a(
        turned_by(turn, channel(kChannelLength, kChannelWidth, kChannelHeight, kChannelWall)));
    const Subject b(turned_by(turn, filling(0, kChannelLength - 200'000, 0)));
    if (!interiors_meet(a, b)) continue;
    ++met;
    const auto proved = shrunk(a, b);
    ASSERT_TRUE(proved) << "seed " << seed;
    EXPECT_LE(proved->depth, kMax);
    expect_none_deeper(a, b, proved->depth, seed);
    const Depth d = depth_from_touch(a, b, {.threshold = 500, .apart_within = kMax});
    EXPECT_LE(d.upper, kMax) << "seed " << seed;
    EXPECT_LE(d.lower, d.value);
    EXPECT_LE(d.value, d.upper);
    EXPECT_EQ(d.cells, 0U) << "seed " << seed;
  }
  EXPECT_GT(met, 20);
}

TEST(SeparatingDisplacementTest, WhatIsDeeperIsNeverATie) {
  int ties = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed)
    for (const std::int32_t over : {1, 2, 3, 4, 6, 8, 500}) {
      const Mat3d turn = seed == 0 ? Mat3d{} : Draw(seed).rotation();
      const Subject a(
          turned_by(turn, channel(kChannelLength, kChannelWidth, kChannelHeight, kChannelWall)));
      const Subject b(turned_by(turn, filling(seed % 2 == 0 ? 0 : 100'000, 900'000, over)));
      const auto proved = shrunk(a, b);
      if (over >= 6) {
        EXPECT_FALSE(proved) << "seed " << seed << ", over by " << over;
      }
      if (!proved) continue;
      ++ties;
      expect_none_deeper(a, b, proved->depth, seed);
    }
  EXPECT_GE(ties, 10);
}

/// All of one skin is in the other, or within the ties of it: only a point that is clear tells.
TEST(SeparatingDisplacementTest, WhatIsInsideOrTheSameIsNoTie) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Mat3d turn = Draw(seed).rotation();
    const Subject a(
        turned_by(turn, channel(kChannelLength, kChannelWidth, kChannelHeight, kChannelWall)));
    EXPECT_FALSE(shrunk(a, a)) << "seed " << seed;
    const Subject floor(turned_by(turn, box_mesh({1000, 1000, 1000}, {900'000, 100'000, 9'000})));
    EXPECT_FALSE(shrunk(a, floor)) << "seed " << seed;
    EXPECT_FALSE(shrunk(floor, a)) << "seed " << seed;
    const Subject flush(
        turned_by(turn, box_mesh({0, 0, 0}, {kChannelLength, kChannelWidth, kChannelWall})));
    EXPECT_FALSE(shrunk(a, flush)) << "seed " << seed;
    EXPECT_FALSE(shrunk(flush, a)) << "seed " << seed;
  }
}

/// Bodies of all kinds in each other by a few grid units or many.
TEST(SeparatingDisplacementTest, NoSampleIsDeeper) {
  int ties = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Draw draws(seed);
    const Mat3d turn = draws.rotation();
    const std::array<IndexedMesh, 4> kinds{
        channel(300'000, 60'000, 50'000, 6'000), beam(300'000, 60'000, 80'000, 5'000, 4'000),
        testing::tube(24, 30'000, 26'000, 0, 200'000), box_mesh({}, {90'000, 40'000, 20'000})};
    const Subject a(turned_by(turn, kinds[draws.below(4)]));
    IndexedMesh other = turned_by(turn, kinds[draws.below(4)]);
    // One corner on another, or flush along an axis of the turn, a few grid units off.
    const auto any = [&](const auto& vertices) { return vertices[draws.below(vertices.size())]; };
    Vec3i by = any(a.part.vertices) - any(other.vertices);
    for (int k = 0; k < 3; ++k) by[k] += draws.whole(-3, 4);
    for (Vec3i& v : other.vertices) v = v + by;
    const Subject b(other);
    const auto proved = shrunk(a, b);
    if (!proved) continue;
    ++ties;
    expect_none_deeper(a, b, proved->depth, seed);
  }
  EXPECT_GT(ties, 20);
}

}  // namespace
}  // namespace strake::geometry
