// SPDX-License-Identifier: Apache-2.0
// A field that is prepared for many questions gives the answers that it gave before, also where its
// triangles are needles that lie askew and are found by boxes along them.
#include "geometry/interior_depth/surface_distance/distance_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "../../support/draw.hpp"
#include "../../support/nonconvex_bodies.hpp"
#include "geometry/interior_depth/level_search/level_search.hpp"

namespace strake::geometry {
namespace {

using test::Draw;
using testing::Subject;
using testing::tube;
using testing::turned_by;

/// An insulation, at some place, and a field with another origin.
struct Insulation {
  Subject subject;
  PartWithBvh treed = subject.treed();
  FaceKdop planes = make_face_kdop(subject.part);
  DistanceField field{treed, {700, -300, 90}, &planes};
  DistanceField prepared = field;

  explicit Insulation(std::uint64_t seed)
      : subject(turned_by(seed == 0 ? Mat3d{} : Draw(seed).rotation(),
                          tube(32, 97'000, 57'000, 0, 900'000)),
                {5000, 7000, -3000}) {
    prepared.prepare();
  }
};

/// Near the skin, on it, and anywhere.
Vec3d draw_point(const DistanceField& field, Draw& draws) {
  const Triangle& t = field.part().triangles[draws.below(field.part().triangles.size())];
  std::array<double, 3> weights{draws.between(0, 1), draws.between(0, 1), draws.between(0, 1)};
  const double sum = weights[0] + weights[1] + weights[2];
  Vec3d p;
  for (std::size_t k = 0; k < 3; ++k)
    p = p + field.common(field.part().vertices[t[k]].as<double>()) * (weights[k] / sum);
  constexpr std::array<double, 4> kReach{0, 1, 5'000, 200'000};
  const double reach = kReach[draws.below(kReach.size())];
  for (int k = 0; k < 3; ++k) p[k] += draws.between(-reach, reach);
  return on_field_grid(p);
}

TEST(DistanceField, APreparedOneGivesTheSameAnswers) {
  int inside = 0;
  for (std::uint64_t seed = 0; seed <= 20; ++seed) {
    const Insulation of(seed);
    Draw draws(100 + seed);
    QueryContext work;
    for (int i = 0; i < 400; ++i) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", point " << i);
      const Vec3d p = draw_point(of.field, draws);
      const PointSide side = of.field.side(p, work);
      inside += side == PointSide::inside ? 1 : 0;
      EXPECT_EQ(of.prepared.side(p, work), side);
      const NearestTriangle near = of.field.nearest(p), again = of.prepared.nearest(p);
      EXPECT_NEAR(again.distance, near.distance, 1e-6);
      if (near.distance > 1) {
        EXPECT_EQ(of.prepared.nearest(p, kNoIndex, near.distance / 2).triangle, kNoIndex);
      }
      EXPECT_GE(of.prepared.distance_upper_bound(p), near.distance - 1e-6);
    }
  }
  EXPECT_GT(inside, 500);
}

/// But for those that are too far off, of which some may come too.
TEST(DistanceField, AllThatIsNearIsFound) {
  for (std::uint64_t seed = 0; seed <= 20; ++seed) {
    const Insulation of(seed);
    Draw draws(200 + seed);
    for (int i = 0; i < 50; ++i) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", points " << i);
      const std::array<Vec3d, 3> points{draw_point(of.field, draws), draw_point(of.field, draws),
                                        draw_point(of.field, draws)};
      const double reach = draws.between(0, 20'000);
      std::vector<bool> round_first(of.field.part().triangles.size()), round_all = round_first;
      of.prepared.for_each_near(points[0], reach,
                                [&](std::uint32_t t) { return round_first[t] = true; });
      of.prepared.for_each_near(points, reach,
                                [&](std::uint32_t t) { return round_all[t] = true; });
      for (std::uint32_t t = 0; t < round_all.size(); ++t) {
        const Corners c = of.field.placed(t);
        const auto is_near = [&](const Vec3d& p) {
          return length(nearest_on_triangle(p, c) - p) <= reach;
        };
        EXPECT_TRUE(round_first[t] || !is_near(points[0]));
        EXPECT_TRUE(round_all[t] || std::ranges::none_of(points, is_near));
      }
    }
  }
}

/// Of a pipe of 32 sides few boxes hold a point, however it is turned.
TEST(DistanceField, NeedlesThatLieAskewAreFoundByBoxesAlongThem) {
  std::array<std::uint64_t, 2> visited{};
  for (const std::uint64_t seed : {0U, 1U}) {
    const Insulation of(seed);
    Draw draws(300);
    for (int i = 0; i < 400; ++i)
      visited[seed] += of.prepared.nearest(draw_point(of.field, draws)).visited;
  }
  EXPECT_LT(visited[1], 2 * visited[0]);
}

TEST(PreparedTriangle, NearestPointsAreThose) {
  Draw draws(7);
  const auto point = [&](double size) {
    return Vec3d{draws.between(-size, size), draws.between(-size, size),
                 draws.between(-size, size)};
  };
  for (int i = 0; i < 20'000; ++i) {
    SCOPED_TRACE(i);
    Corners c{point(1e5), point(1e5), point(1e5)};
    // Slivers too.
    if (i % 3 == 1) c[2] = c[0] + (c[1] - c[0]) * draws.between(-1, 2) + point(1);
    if (i % 3 == 2) c[2] = c[0] + (c[1] - c[0]) * draws.between(-1, 2) + point(1e-4);
    const PreparedTriangle triangle(c);
    Vec3d p = point(2e5);
    if (i % 5 == 0) p = c[0] + (c[1] - c[0]) * draws.between(-1, 2) + point(10);
    const double distance = length(nearest_on_triangle(p, c) - p);
    EXPECT_NEAR(length(triangle.nearest(p) - p), distance, 1e-6 * (1 + distance));
    if (triangle.has_behind(p)) {
      EXPECT_LT(dot(triangle.unit, p - c[0]), 0);
      EXPECT_NEAR(-dot(triangle.unit, p - c[0]), distance, 1e-6 * (1 + distance));
    }
  }
}

/// And are tight.
TEST(HalfSpaces, HoldThePart) {
  for (std::uint64_t seed = 0; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Insulation of(seed);
    const std::vector<HalfSpace> hull = half_spaces_of(of.prepared);
    EXPECT_GT(hull.size(), 10U);
    for (const HalfSpace& h : hull) {
      double most = -std::numeric_limits<double>::infinity();
      for (const Vec3i& v : of.field.part().vertices)
        most = std::max(most, dot(h.normal, of.field.common(v.as<double>())));
      EXPECT_NEAR(most, h.offset, 1);
      EXPECT_LE(most, h.offset + 1e-6);
      EXPECT_NEAR(length(h.normal), 1, 1e-9);
    }
  }
}

}  // namespace
}  // namespace strake::geometry
