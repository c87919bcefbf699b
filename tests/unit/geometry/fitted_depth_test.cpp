// SPDX-License-Identifier: Apache-2.0
// Depth of bodies that fit into the corners and hollows of others, flush or a little too large.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

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
using testing::extruded;
using testing::IndexedMesh;
using testing::interiors_meet;
using testing::Subject;
using testing::turned_by;

/// What the snap to the grid may add to a depth, or take from it: each body moves by less than one
/// diagonal of a cell.
constexpr double kSnap = 2;

/// None for seed 0.
Mat3d drawn_turn(std::uint64_t seed) { return seed == 0 ? Mat3d{} : Draw(seed).rotation(); }

constexpr std::int32_t kLength = 1'000'000, kWidth = 120'000, kHeight = 110'000, kWall = 10'000;

/// Fills a channel, and goes into its walls and its floor by `over`.
IndexedMesh filling(std::int32_t over) {
  return box_mesh({0, kWall - over, kWall - over}, {kLength, kWidth - kWall + over, kHeight});
}

/// An angle along x: a channel without one of its walls.
IndexedMesh angle() {
  const std::array<std::array<std::int32_t, 2>, 6> outline{
      {{0, 0}, {kWidth, 0}, {kWidth, kWall}, {kWall, kWall}, {kWall, kHeight}, {0, kHeight}}};
  constexpr std::array<std::array<std::uint32_t, 4>, 2> kEnds{{{0, 1, 2, 3}, {0, 3, 4, 5}}};
  return extruded(kLength, outline, kEnds);
}

/// The deepest points are on the edges of what fills the channel, a diagonal from its inner edges.
void expect_diagonal(const IndexedMesh& outer, const IndexedMesh& inner, double over,
                     std::uint64_t seed) {
  const double truth = over * std::numbers::sqrt2;
  const Mat3d turn = drawn_turn(seed);
  const Subject a(turned_by(turn, outer)), b(turned_by(turn, inner));
  if (over == 0 && !interiors_meet(a, b)) return;
  for (const bool swapped : {false, true}) {
    const Depth d = swapped ? depth_from_touch(b, a, {.threshold = 1000})
                            : depth_from_touch(a, b, {.threshold = 1000});
    EXPECT_LE(d.lower, truth + kSnap) << "seed " << seed << ", over by " << over;
    EXPECT_GE(d.upper, truth - kSnap) << "seed " << seed << ", over by " << over;
    EXPECT_LE(d.upper - d.lower, 12 + 0.0201 * truth) << "seed " << seed << ", over by " << over;
    EXPECT_LT(d.cells, 700U) << "seed " << seed << ", over by " << over;
  }
}

TEST(FittedDepth, ABoxThatFillsAChannel) {
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    for (const std::int32_t over : {0, 500, 3000})
      expect_diagonal(channel(kLength, kWidth, kHeight, kWall), filling(over), over, seed);
}

TEST(FittedDepth, ABoxInTheCornerOfAnAngle) {
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    for (const std::int32_t over : {0, 500, 3000})
      expect_diagonal(angle(),
                      box_mesh({100'000, kWall - over, kWall - over},
                               {500'000, kWall + 60'000, kWall + 60'000}),
                      over, seed);
}

TEST(FittedDepth, AStiffenerBetweenTheFlangesOfABeam) {
  const IndexedMesh outer = beam(2'000'000, 100'000, 200'000, 10'000, 8'000);
  const IndexedMesh inner = box_mesh({300'000, 4'000, 10'000}, {320'000, 50'000, 190'000});
  for (std::uint64_t seed = 0; seed < 12; ++seed) expect_diagonal(outer, inner, 0, seed);
}

/// What fits within the width of a few grid units, too thin to be cut off, and whatever sticks out
/// of the ends of what holds it: no sample is deeper than the bracket.
TEST(FittedDepth, NoSampleIsDeeperThanTheBracket) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Draw draws(seed + 100);
    const std::int32_t length = draws.whole(20'000, 60'000), wall = draws.whole(300, 4'000);
    const std::int32_t width = draws.whole(12'000, 30'000), height = draws.whole(9'000, 30'000);
    Vec3i lo{}, hi{length, width - wall, height};
    lo.y = lo.z = wall;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t reach = k == 0 && seed % 2 == 0 ? 4'000 : 90;
      lo[k] -= draws.whole(-reach / 3, reach);
      hi[k] += draws.whole(-reach / 3, reach);
    }
    const Mat3d turn = drawn_turn(seed);
    const Subject a(turned_by(turn, channel(length, width, height, wall)));
    const IndexedMesh inner = turned_by(turn, box_mesh(lo, hi));
    const Subject b(inner);
    if (!interiors_meet(a, b)) continue;
    const Depth d = depth_from_touch(a, b, {.threshold = 1000});
    EXPECT_LE(d.lower, d.upper) << "seed " << seed;
    EXPECT_LE(d.upper - d.lower, std::max(200.0, 0.0201 * d.upper)) << "seed " << seed;
    for (int i = 0; i < 3000; ++i) {
      // Near the edges of the inner body, where it stands in the other.
      const Vec3d p = inner.vertices[static_cast<std::size_t>(draws.whole(0, 8))].as<double>();
      const Vec3d q = inner.vertices[static_cast<std::size_t>(draws.whole(0, 8))].as<double>();
      Vec3d at = p + (q - p) * draws.between(0, 1);
      for (int k = 0; k < 3; ++k) at[k] += draws.between(-100, 100);
      const Vec3l x{std::llround(at.x), std::llround(at.y), std::llround(at.z)};
      ASSERT_LE(depth_at(a, b, x), d.upper + 1e-3) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace strake::geometry
