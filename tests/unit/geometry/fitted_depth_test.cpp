// SPDX-License-Identifier: Apache-2.0
// Depth of bodies that fit into the corners and hollows of others, flush or a little too large.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>

#include "../../support/depth_subjects.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

using testing::beam;
using testing::box_mesh;
using testing::channel;
using testing::extruded;
using testing::IndexedMesh;
using testing::Subject;

/// What the snap to the grid may add to a depth, or take from it: each body moves by less than one
/// diagonal of a cell.
constexpr double kSnap = 2;

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed) {}
  double real(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }
  std::int32_t whole(std::int32_t lo, std::int32_t hi) {
    return static_cast<std::int32_t>(std::floor(real(lo, hi)));
  }

 private:
  std::mt19937_64 random_;
};

using Turn = std::array<Vec3d, 3>;

/// None for seed 0, otherwise by a drawn quaternion.
Turn drawn_turn(std::uint64_t seed) {
  if (seed == 0) return {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  Draws draws(seed);
  std::array<double, 4> q{};
  double sum = 0;
  for (double& x : q) {
    x = draws.real(-1, 1);
    sum += x * x;
  }
  for (double& x : q) x /= std::sqrt(sum);
  const auto& [w, x, y, z] = q;
  return {Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
          Vec3d{2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
          Vec3d{2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
}

IndexedMesh turned_by(const Turn& turn, IndexedMesh mesh) {
  for (Vec3i& v : mesh.vertices) {
    const Vec3d p = v.as<double>();
    for (int k = 0; k < 3; ++k)
      v[k] = static_cast<std::int32_t>(std::lround(dot(turn[static_cast<std::size_t>(k)], p)));
  }
  return mesh;
}

/// Whether interior is common: the snap may part what is flush.
bool interferes(const Subject& a, const Subject& b) {
  PairWork work;
  const Meeting meeting = meet(a.treed(), b.treed(), work).meeting;
  return meeting != Meeting::apart && meeting != Meeting::touching;
}

/// With the touch that `meet` finds, as the narrow phase asks.
Depth fitted_depth(const Subject& a, const Subject& b, DepthGoal goal) {
  PairWork work;
  const MeetingResult meeting = meet(a.treed(), b.treed(), work);
  goal.triangle_a = meeting.triangle_a;
  goal.triangle_b = meeting.triangle_b;
  goal.meeting_point = meeting.point;
  return testing::depth_of(a, b, goal);
}

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
  const Turn turn = drawn_turn(seed);
  const Subject a(turned_by(turn, outer)), b(turned_by(turn, inner));
  if (over == 0 && !interferes(a, b)) return;
  for (const bool swapped : {false, true}) {
    const Depth d =
        swapped ? fitted_depth(b, a, {.threshold = 1000}) : fitted_depth(a, b, {.threshold = 1000});
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
    Draws draws(seed + 100);
    const std::int32_t length = draws.whole(20'000, 60'000), wall = draws.whole(300, 4'000);
    const std::int32_t width = draws.whole(12'000, 30'000), height = draws.whole(9'000, 30'000);
    Vec3i lo{}, hi{length, width - wall, height};
    lo.y = lo.z = wall;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t reach = k == 0 && seed % 2 == 0 ? 4'000 : 90;
      lo[k] -= draws.whole(-reach / 3, reach);
      hi[k] += draws.whole(-reach / 3, reach);
    }
    const Turn turn = drawn_turn(seed);
    const Subject a(turned_by(turn, channel(length, width, height, wall)));
    const IndexedMesh inner = turned_by(turn, box_mesh(lo, hi));
    const Subject b(inner);
    if (!interferes(a, b)) continue;
    PairWork work;
    const Depth d = fitted_depth(a, b, {.threshold = 1000});
    EXPECT_LE(d.lower, d.upper) << "seed " << seed;
    EXPECT_LE(d.upper - d.lower, std::max(200.0, 0.0201 * d.upper)) << "seed " << seed;
    for (int i = 0; i < 3000; ++i) {
      // Near the edges of the inner body, where it stands in the other.
      const Vec3d p = inner.vertices[static_cast<std::size_t>(draws.whole(0, 8))].as<double>();
      const Vec3d q = inner.vertices[static_cast<std::size_t>(draws.whole(0, 8))].as<double>();
      Vec3d at = p + (q - p) * draws.real(0, 1);
      for (int k = 0; k < 3; ++k) at[k] += draws.real(-100, 100);
      const Vec3l x{std::llround(at.x), std::llround(at.y), std::llround(at.z)};
      if (side_of(a.treed(), x, 1, work) == PointSide::outside) continue;
      if (side_of(b.treed(), x, 1, work) == PointSide::outside) continue;
      const double deep = std::max(nearest_on_skin(a.treed(), x.as<double>()).distance,
                                   nearest_on_skin(b.treed(), x.as<double>()).distance);
      ASSERT_LE(deep, d.upper + 1e-3) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace strake::geometry
