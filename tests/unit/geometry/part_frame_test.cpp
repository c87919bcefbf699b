// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/part_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "support/part_builder.hpp"

namespace strake::geometry {
namespace {

using testing::box_mesh;
using testing::IndexedMesh;
using testing::Subject;

constexpr double kAny = std::numeric_limits<double>::infinity();

double gap(const Subject& a, const Subject& b, double enough = kAny) {
  const PartFrame f = make_frame(a.part), g = make_frame(b.part);
  return frame_gap({a.treed().placed, &f}, {b.treed().placed, &g}, enough);
}

/// Turned by a rotation of rational entries, snapped.
IndexedMesh askew(IndexedMesh mesh) {
  for (Vec3i& v : mesh.vertices) {
    const Vec3d p = v.as<double>();
    v = {static_cast<std::int32_t>(std::lround((2 * p.x - p.y + 2 * p.z) / 3)),
         static_cast<std::int32_t>(std::lround((2 * p.x + 2 * p.y - p.z) / 3)),
         static_cast<std::int32_t>(std::lround((-p.x + 2 * p.y + 2 * p.z) / 3))};
  }
  return mesh;
}

TEST(PartFrame, BoxesAskewShowTheirTrueGap) {
  const IndexedMesh plate = askew(box_mesh({0, 0, 0}, {900'000, 600'000, 3'000}));
  const Subject a(plate);
  for (const std::int32_t apart : {-9, 0, 9, 1'001, 30'000}) {
    const Subject b(askew(box_mesh({90'000, 30'000, 3'000 + apart}, {300'000, 90'000, 90'000})));
    EXPECT_NEAR(gap(a, b), apart, 6);
    EXPECT_NEAR(gap(b, a), apart, 6);
  }
  // Their boxes along the coordinate axes overlap by far.
  const Subject c(askew(box_mesh({0, 0, 50'000}, {900'000, 600'000, 53'000})));
  EXPECT_TRUE(a.part.box.meets(c.part.box));
  EXPECT_GT(gap(a, c), 46'990);
}

/// A prism round z whose ends are fans of needles from one of their corners.
IndexedMesh disc(double radius, std::int32_t low, std::int32_t high, std::uint32_t sides) {
  std::vector<Vec3i> ring;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    ring.push_back({static_cast<std::int32_t>(std::lround(radius * std::cos(angle))),
                    static_cast<std::int32_t>(std::lround(radius * std::sin(angle))), 0});
  }
  return testing::prism_mesh(ring, low, high);
}

TEST(PartFrame, FacesOfNeedlesShowTheirTrueGap) {
  // The largest needle of an end looks along it no better than to a thousandth.
  const Subject a(askew(disc(500'000, 0, 10'000, 2500)));
  for (const std::int32_t apart : {-9, 0, 9, 1'001, 30'000}) {
    const Subject b(askew(disc(400'000, 10'000 + apart, 20'000 + apart, 2100)));
    EXPECT_NEAR(gap(a, b), apart, 6);
    EXPECT_NEAR(gap(b, a), apart, 6);
  }
}

TEST(PartFrame, NoGapIsWiderThanTheDistance) {
  int apart = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](int lo, int hi) {
      return lo + static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(hi - lo));
    };
    const auto body = [&](bool turn) {
      const Vec3i size{draw(1, 400), draw(1, 90), draw(1, 30)};
      const IndexedMesh mesh =
          draw(0, 3) == 0
              ? testing::prism_mesh(
                    std::array<Vec3i, 3>{Vec3i{0, 0, 0}, {size.x, 0, 0}, {size.z, size.y, 0}}, 0,
                    size.z)
              : box_mesh({0, 0, 0}, size);
      return turn ? askew(mesh) : mesh;
    };
    const Vec3l far{seed % 3 == 0 ? 1LL << 40 : 0, 0, 0};
    const Subject a(body(true), far);
    const Subject b(body(seed % 2 == 0),
                    far + Vec3l{draw(-500, 500), draw(-200, 200), draw(-90, 90)});
    if (a.part.triangles.empty() || b.part.triangles.empty()) continue;
    PairWork work;
    const MeetingResult meeting = meet(a.treed(), b.treed(), work);
    const double g = gap(a, b);
    EXPECT_NEAR(g, gap(b, a), 1e-6) << "seed " << seed;
    if (meeting.meeting != Meeting::apart) {
      EXPECT_LE(g, 0) << "seed " << seed;
      continue;
    }
    ++apart;
    EXPECT_LE(g, closest(a.treed(), b.treed(), kAny, work)->distance) << "seed " << seed;
    // An early end is no more than another bound.
    const double enough = gap(a, b, 5);
    EXPECT_LE(enough, g + 1e-9) << "seed " << seed;
    EXPECT_EQ(enough >= 5, g >= 5) << "seed " << seed;
  }
  EXPECT_GT(apart, 100);
}

TEST(PartFrame, ANegativeGapIsAWayOut) {
  const Subject a(askew(box_mesh({0, 0, 0}, {900, 600, 300})));
  const Subject b(askew(box_mesh({100, 100, 290}, {300, 300, 900})));
  const double g = gap(a, b);
  EXPECT_NEAR(g, -10, 3);
  PairWork work;
  const Subject moved(askew(box_mesh({100, 100, 290 + 14}, {300, 300, 900 + 14})));
  EXPECT_EQ(meet(a.treed(), moved.treed(), work).meeting, Meeting::apart);
}

TEST(AnyWithin, FindsSomethingAsNearIfThereIsAnything) {
  const Subject a(askew(box_mesh({0, 0, 0}, {900'000, 600'000, 3'000})));
  const Subject b(askew(box_mesh({90'000, 30'000, 3'009}, {300'000, 90'000, 90'000})));
  PairWork work;
  const auto closest_pair = closest(a.treed(), b.treed(), kAny, work);
  ASSERT_TRUE(closest_pair);
  const auto near = any_within(a.treed(), b.treed(), 20, work);
  ASSERT_TRUE(near);
  EXPECT_LE(near->distance, 20);
  EXPECT_GE(near->distance, closest_pair->distance);
  const Vec3d off = near->on_b - near->on_a;
  EXPECT_NEAR(std::sqrt(dot(off, off)), near->distance, 1e-6);
  EXPECT_FALSE(any_within(a.treed(), b.treed(), closest_pair->distance - 1e-3, work));
}

}  // namespace
}  // namespace strake::geometry
