// SPDX-License-Identifier: Apache-2.0
#include "geometry/obb/oriented_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/distance/slab_proximity.hpp"
#include "support/part_builder.hpp"

namespace strake::geometry {
namespace {

using testing::box_mesh;
using testing::IndexedMesh;
using testing::Subject;

constexpr double kAny = std::numeric_limits<double>::infinity();

SeparationBound parting(const Subject& a, const Subject& b, double cutoff = kAny) {
  const OrientedBox f = make_oriented_box(a.part), g = make_oriented_box(b.part);
  return oriented_box_separation({a.treed().placed, &f}, {b.treed().placed, &g}, cutoff);
}

double gap(const Subject& a, const Subject& b, double cutoff = kAny) {
  return parting(a, b, cutoff).lower;
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

/// The least height along a direction, in coordinates moved by a shift.
double lowest(const Subject& subject, const Vec3d& n, const Vec3l& shift) {
  double least = kAny;
  for (const Vec3i& v : subject.part.vertices)
    least = std::min(least, dot(n, (v.as<std::int64_t>() + shift).as<double>()));
  return least;
}

TEST(OrientedBox, BoxesAskewShowTheirTrueGap) {
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
IndexedMesh disc(double radius, std::int32_t low, std::int32_t high, std::uint32_t sides,
                 const Vec3i& at = {}) {
  std::vector<Vec3i> ring;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    ring.push_back({at.x + static_cast<std::int32_t>(std::lround(radius * std::cos(angle))),
                    at.y + static_cast<std::int32_t>(std::lround(radius * std::sin(angle))), 0});
  }
  return testing::prism_mesh(ring, low, high);
}

TEST(OrientedBox, FacesOfNeedlesShowTheirTrueGap) {
  // The largest needle of an end looks along it no better than to a thousandth.
  const Subject a(askew(disc(500'000, 0, 10'000, 2500)));
  for (const std::int32_t apart : {-9, 0, 9, 1'001, 30'000}) {
    const Subject b(askew(disc(400'000, 10'000 + apart, 20'000 + apart, 2100)));
    EXPECT_NEAR(gap(a, b), apart, 6);
    EXPECT_NEAR(gap(b, a), apart, 6);
  }
}

TEST(OrientedBox, NoGapIsWiderThanTheDistance) {
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
    QueryContext work;
    const MeetingResult meeting = meet(a.treed(), b.treed(), work);
    const double g = gap(a, b);
    EXPECT_NEAR(g, gap(b, a), 1e-6) << "seed " << seed;
    if (meeting.meeting != Meeting::apart) {
      EXPECT_LE(g, 0) << "seed " << seed;
      continue;
    }
    ++apart;
    EXPECT_LE(g, find_closest_pair(a.treed(), b.treed(), kAny, work)->distance) << "seed " << seed;
    // Across its normal all of a is above all of b by so much.
    const Vec3d n = parting(a, b).normal;
    EXPECT_GE(lowest(a, n, {}) + lowest(b, -n, b.origin - a.origin), g) << "seed " << seed;
    // An early end is no more than another bound.
    const double cutoff = gap(a, b, 5);
    EXPECT_LE(cutoff, g + 1e-9) << "seed " << seed;
    EXPECT_EQ(cutoff >= 5, g >= 5) << "seed " << seed;
  }
  EXPECT_GT(apart, 100);
}

TEST(OrientedBox, ANegativeGapIsAWayOut) {
  const Subject a(askew(box_mesh({0, 0, 0}, {900, 600, 300})));
  const Subject b(askew(box_mesh({100, 100, 290}, {300, 300, 900})));
  const double g = gap(a, b);
  EXPECT_NEAR(g, -10, 3);
  QueryContext work;
  const Subject moved(askew(box_mesh({100, 100, 290 + 14}, {300, 300, 900 + 14})));
  EXPECT_EQ(meet(a.treed(), moved.treed(), work).meeting, Meeting::apart);
}

TEST(PairWithinDistance, FindsSomethingAsNearIfThereIsAnything) {
  const Subject a(askew(box_mesh({0, 0, 0}, {900'000, 600'000, 3'000})));
  const Subject b(askew(box_mesh({90'000, 30'000, 3'009}, {300'000, 90'000, 90'000})));
  QueryContext work;
  const auto closest_pair = find_closest_pair(a.treed(), b.treed(), kAny, work);
  ASSERT_TRUE(closest_pair);
  const auto near = find_pair_within(a.treed(), b.treed(), 20, work);
  ASSERT_TRUE(near);
  EXPECT_LE(near->distance, 20);
  EXPECT_GE(near->distance, closest_pair->distance);
  const Vec3d off = near->on_b - near->on_a;
  EXPECT_NEAR(std::sqrt(dot(off, off)), near->distance, 1e-6);
  EXPECT_FALSE(find_pair_within(a.treed(), b.treed(), closest_pair->distance - 1e-3, work));
}

SlabProximity across(const Subject& a, const Subject& b, double distance, QueryContext& work) {
  return slab_proximity(a.treed().placed, b.treed().placed, parting(a, b).normal, distance, work);
}

TEST(SlabProximity, LooksAtNothingButTheFacesThatMeet) {
  const Subject deck(askew(box_mesh({0, 0, 0}, {900'000, 600'000, 3'000})));
  const Subject pipe(askew(disc(50'000, 3'002, 900'000, 24, {300'000, 200'000, 0})));
  QueryContext work;
  const SlabProximity found = across(deck, pipe, 8, work);
  ASSERT_TRUE(found.decided && found.near);
  EXPECT_LE(found.near->distance, 8);
  EXPECT_LE(work.triangle_pairs, 2U * 22U);
  const Vec3d off = found.near->on_b - found.near->on_a;
  EXPECT_NEAR(std::sqrt(dot(off, off)), found.near->distance, 1e-6);
}

TEST(SlabProximity, StatesThatThereIsNothing) {
  const Subject deck(askew(box_mesh({0, 0, 0}, {900'000, 600'000, 3'000})));
  // Beside each other in the plane: no triangles are near, although the slab is narrow.
  const Subject beside(askew(box_mesh({900'100, 0, 3'000}, {990'000, 600'000, 9'000})));
  QueryContext work;
  const SlabProximity none = across(deck, beside, 8, work);
  EXPECT_TRUE(none.decided);
  EXPECT_FALSE(none.near);
  // Of many needles nothing is known: trees tell.
  const Subject plate(askew(disc(500'000, 3'001, 10'000, 600)));
  const SlabProximity unknown = across(deck, plate, 8, work);
  EXPECT_FALSE(unknown.decided);
  EXPECT_FALSE(unknown.near);
}

TEST(SlabProximity, FindsWhatAWalkFinds) {
  int found = 0, none = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](int lo, int hi) {
      return lo + static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(hi - lo));
    };
    const auto body = [&](std::int32_t low) {
      const Vec3i at{draw(0, 900), draw(0, 900), 0};
      return draw(0, 2) == 0 ? askew(disc(draw(60, 300), low, low + 90, 7, at))
                             : askew(box_mesh({at.x, at.y, low}, {at.x + draw(20, 400),
                                                                  at.y + draw(20, 400), low + 90}));
    };
    const Subject a(body(0)), b(body(90 + draw(-3, 9)));
    QueryContext work;
    const SeparationBound slab = parting(a, b);
    const SlabProximity quick =
        slab_proximity(a.treed().placed, b.treed().placed, slab.normal, 8, work);
    ASSERT_TRUE(quick.decided) << "seed " << seed;
    const auto walked = find_pair_within(a.treed(), b.treed(), 8, work);
    EXPECT_EQ(quick.near.has_value(), walked.has_value()) << "seed " << seed;
    ++(quick.near ? found : none);
    if (!quick.near) continue;
    EXPECT_LE(quick.near->distance, 8) << "seed " << seed;
    EXPECT_GE(quick.near->distance, find_closest_pair(a.treed(), b.treed(), 9, work)->distance)
        << "seed " << seed;
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(none, 100);
}

}  // namespace
}  // namespace strake::geometry
