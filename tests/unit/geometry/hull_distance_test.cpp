// SPDX-License-Identifier: Apache-2.0
#include "geometry/distance/hull_distance.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "strake/geometry/part_pair.hpp"
#include "support/draw.hpp"
#include "support/nonconvex_bodies.hpp"
#include "support/part_builder.hpp"

namespace strake::geometry {
namespace {

using test::Draw;
using testing::IndexedMesh;
using testing::Subject;

constexpr double kFar = std::numeric_limits<double>::infinity();

IndexedMesh shifted(IndexedMesh mesh, const Vec3i& by) {
  for (Vec3i& v : mesh.vertices) v = v + by;
  return mesh;
}

SeparationBound gap_of(const Subject& a, const Subject& b, double cutoff = kFar) {
  const OrientedBox x = make_oriented_box(a.part), y = make_oriented_box(b.part);
  return convex_hull_separation({a.treed().placed, &x}, {b.treed().placed, &y}, cutoff);
}

/// Pipes that cross: no face of either stands across the gap.
std::pair<Subject, Subject> crossing_pipes(int sides) {
  const IndexedMesh pipe = testing::cylinder(sides, 100'000, -500'000, 500'000);
  IndexedMesh across = pipe;
  for (Vec3i& v : across.vertices) v = {v.z, v.y, v.x};
  return {Subject(testing::turned(pipe)),
          Subject(testing::turned(shifted(across, {0, 208'000, 0})), {7, 1LL << 40, -3})};
}

TEST(HullDistance, PipesThatCrossComeApartAtOnce) {
  auto [a, b] = crossing_pipes(26);
  b.origin = {};
  QueryContext plain, hinted;
  const auto near = find_closest_pair(a.treed(), b.treed(), kFar, plain);
  ASSERT_TRUE(near);
  const SeparationBound gap = gap_of(a, b);
  EXPECT_LE(gap.lower, near->distance);
  EXPECT_GE(gap.lower, near->distance - 2);
  EXPECT_GE(gap_of(a, b, 5000).lower, 5000);
  EXPECT_EQ(find_closest_pair(a.treed(), b.treed(), kFar, hinted, 0, gap.normal)->squared,
            near->squared);
  EXPECT_GT(plain.node_pairs, 200U);
  EXPECT_EQ(hinted.node_pairs, 0U);
  EXPECT_LT(hinted.triangle_pairs, 100U);
  EXPECT_FALSE(find_closest_pair(a.treed(), b.treed(), near->distance, hinted, 0, gap.normal));
}

TEST(HullDistance, ManyVerticesAndFarOrigins) {
  auto [a, b] = crossing_pipes(2100);
  a.origin = b.origin - Vec3l{0, 0, 1000};
  const SeparationBound gap = gap_of(a, b);
  QueryContext work;
  const auto near = find_closest_pair(a.treed(), b.treed(), kFar, work, 0, gap.normal);
  ASSERT_TRUE(near);
  EXPECT_EQ(work.node_pairs, 0U);
  EXPECT_LE(gap.lower, near->distance);
  EXPECT_GE(gap.lower, near->distance - 2);
}

TEST(HullDistance, NothingIsKnownOfWhatMeets) {
  const Subject a(testing::box_mesh({0, 0, 0}, {100, 100, 100}));
  for (const std::int32_t x : {-50, 0, 50, 100})
    EXPECT_LE(gap_of(a, Subject(testing::box_mesh({x, 10, 20}, {x + 100, 60, 70}))).lower, 0);
  // In the mouth of a channel: apart, their hulls are not.
  EXPECT_LE(gap_of(Subject(testing::channel(1000, 300, 300, 20)),
                   Subject(testing::box_mesh({100, 100, 100}, {200, 200, 200})))
                .lower,
            0);
}

IndexedMesh draw_body(Draw& draw) {
  const auto size = [&] { return 1000 * (1 + static_cast<std::int32_t>(draw.below(6))); };
  switch (draw.below(6)) {
    case 0:
      return testing::box_mesh({}, {size(), size(), size()});
    case 1:
      return testing::cylinder(3 + static_cast<int>(draw.below(12)), size(), 0, size());
    case 2:
      return testing::tube(8, 4000, 3000, 0, size());
    case 3:
      return testing::channel(size(), 4000, 3000, 500);
    case 4:
      return testing::crosswise(testing::beam(size(), 4000, 6000, 500, 500));
    default:
      return testing::quad_mesh({}, {size(), 0, 0}, {0, size(), 0});
  }
}

/// Ties are the rule on a lattice; the triangles named are then the first among them.
TEST(HullDistance, TheHintChangesNoAnswer) {
  int apart = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const auto place = [&] { return 1000 * (static_cast<std::int32_t>(draw.below(20)) - 10); };
    IndexedMesh x = draw_body(draw), y = draw_body(draw);
    const std::int32_t by_x = place(), by_y = place(), by_z = place();
    y = shifted(std::move(y), {by_x, by_y, by_z});
    if (draw.below(2) == 0) {
      x = testing::turned(std::move(x));
      y = testing::turned(std::move(y));
    }
    const Subject a(x), b(y);
    const SeparationBound gap = gap_of(a, b);
    const double limit = draw.below(2) == 0 ? kFar : 2500;
    QueryContext plain, hinted;
    const auto near = find_closest_pair(a.treed(), b.treed(), limit, plain);
    EXPECT_LE(gap.lower, near ? near->distance : kFar);
    if (!(gap.lower > 0)) continue;
    ++apart;
    const auto same = find_closest_pair(a.treed(), b.treed(), limit, hinted, 0, gap.normal);
    ASSERT_EQ(same.has_value(), near.has_value());
    if (!near) continue;
    EXPECT_EQ(same->distance, near->distance);
    EXPECT_EQ(same->squared, near->squared);
    EXPECT_EQ(same->lower, near->lower);
    EXPECT_EQ(same->triangle_a, near->triangle_a);
    EXPECT_EQ(same->triangle_b, near->triangle_b);
    EXPECT_EQ(same->on_a, near->on_a);
    EXPECT_EQ(same->on_b, near->on_b);
  }
  EXPECT_GT(apart, 1000);
}

/// Of all the triangles that share two edges side by side, one is measured exactly.
TEST(ClosestTest, EqualDistancesAtParallelEdgesAreNotMeasuredAnew) {
  const Subject a(testing::box_mesh({0, 0, 0}, {1000, 1000, 9000}));
  const Subject b(testing::box_mesh({1300, 1400, 1000}, {3000, 3000, 7000}));
  QueryContext work;
  EXPECT_EQ(find_closest_pair(a.treed(), b.treed(), kFar, work)->distance, 500);
  EXPECT_LE(work.exact_fallbacks, 2U);
}

}  // namespace
}  // namespace strake::geometry
