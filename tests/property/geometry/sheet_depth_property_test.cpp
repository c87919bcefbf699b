// SPDX-License-Identifier: Apache-2.0
// How deep sheets cross, stretch by stretch and place by place, against samples of the curve and a
// look at every edge of the rims.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/contact_regions/contact_regions.hpp"
#include "geometry/interior_depth/sheets/sheet_boundary.hpp"
#include "geometry/interior_depth/sheets/sheet_crossing.hpp"
#include "geometry/interior_depth/surface_distance/nearest_triangle.hpp"
#include "geometry/sheet_separation/robust_crossings.hpp"
#include "support/draw.hpp"
#include "support/part_builder.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using test::Draw;
using testing::IndexedMesh;
using testing::Subject;

double brute_distance(const Vec3d& p, const std::vector<SegmentBvh::Segment>& segments) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : segments)
    least = std::min(least, length(p - nearest_on_segment(p, from, to)));
  return least;
}

/// Short ones, long ones, points, and several at one place.
std::vector<SegmentBvh::Segment> random_curve(Draw& draw) {
  const auto point = [&](double size) {
    return Vec3d{draw.between(-size, size), draw.between(-size, size), draw.between(-size, size)};
  };
  std::vector<SegmentBvh::Segment> curve;
  const auto count = draw.below(80);
  const double most = draw.one_in(2) ? 50 : 5000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Vec3d from = draw.one_in(8) && !curve.empty() ? curve.back()[0] : point(10'000);
    curve.push_back({from, draw.one_in(10) ? from : from + point(most)});
  }
  return curve;
}

class SheetDepths : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(SheetDepths, TheNearestOfACurveIsThatOfALookAtAll) {
  Draw draw(GetParam());
  for (int round = 0; round < test::rounds(200, 5000); ++round) {
    SCOPED_TRACE("seed " + std::to_string(GetParam()) + ", round " + std::to_string(round));
    const auto curve = random_curve(draw);
    const SegmentBvh tree(curve);
    for (int i = 0; i < 20; ++i) {
      const Vec3d p{draw.between(-15'000, 15'000), draw.between(-15'000, 15'000),
                    draw.between(-15'000, 15'000)};
      const double limit = draw.one_in(2) ? 1e9 : draw.between(0, 20'000);
      const double least = std::min(brute_distance(p, curve), limit);
      ASSERT_EQ(tree.nearest(p, limit, -1).distance, least);
      const double cutoff = draw.between(0, 10'000);
      const double found = tree.nearest(p, limit, cutoff).distance;
      ASSERT_TRUE(found == least || (found >= least && found <= cutoff));
    }
  }
}

/// Triangles anywhere, or a bumpy grid of them.
IndexedMesh random_sheet(Draw& draw, bool grid) {
  constexpr std::int32_t kSize = 20'000;
  IndexedMesh mesh;
  if (!grid) {
    const auto count = static_cast<std::uint32_t>(2 + draw.below(7));
    for (std::uint32_t t = 0; t < count; ++t) {
      for (int k = 0; k < 3; ++k)
        mesh.vertices.push_back({draw.whole(0, kSize), draw.whole(0, kSize), draw.whole(0, kSize)});
      mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return mesh;
  }
  const auto side = static_cast<std::int32_t>(2 + draw.below(4));
  for (std::int32_t j = 0; j <= side; ++j)
    for (std::int32_t i = 0; i <= side; ++i)
      mesh.vertices.push_back({kSize * i / side, kSize * j / side, draw.whole(-1500, 1500)});
  for (std::int32_t j = 0; j < side; ++j)
    for (std::int32_t i = 0; i < side; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (side + 1) + i);
      const auto b = a + static_cast<std::uint32_t>(side) + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  return mesh;
}

/// The depth of one stretch by definition, at points along it.
struct Sampled {
  double most = 0, uncovered = 0;  ///< and what may lie between two points
};

Sampled sampled(const DoubleSegment& at, const Subject& a, const Subject& b) {
  constexpr int kPoints = 64;
  const auto rim_a = boundary_edges(a.part), rim_b = boundary_edges(b.part);
  Sampled s{.most = 0, .uncovered = length(at[1] - at[0]) / (2 * kPoints)};
  for (int i = 0; i <= kPoints; ++i) {
    const Vec3d p = at[0] + (at[1] - at[0]) * (static_cast<double>(i) / kPoints);
    s.most = std::max(s.most, std::min(brute_distance(p, rim_a), brute_distance(p, rim_b)));
  }
  return s;
}

TEST_P(SheetDepths, AreAsDeepAsTheirStretches) {
  Draw draw(GetParam() + 1000);
  int several = 0;
  for (int round = 0; round < test::rounds(60, 2000); ++round) {
    SCOPED_TRACE("seed " + std::to_string(GetParam()) + ", round " + std::to_string(round));
    const bool grid = draw.one_in(2);
    const Subject a(random_sheet(draw, grid)), b(random_sheet(draw, grid));
    QueryContext work;
    const SheetIntersection curve = find_sheet_intersection(a.treed(), b.treed(), 0, 100'000, work);
    const SheetCrossing crossing(a.treed(), b.treed(), 0, work);
    ASSERT_EQ(crossing.crossing_segments().size(), curve.segments.size());
    const auto places =
        find_contact_regions(a.treed(), b.treed(), {.reach = 10, .interiors_meet = true}, work);
    ASSERT_TRUE(places);
    several += places->all.size() > 1 ? 1 : 0;
    double deepest = 0;
    std::vector<double> by_place(places->all.size(), 0);
    for (std::uint32_t i = 0; i < curve.segments.size(); ++i) {
      const Sampled brute = sampled(curve.segments[i], a, b);
      const Depth d = crossing.depth_along(std::array{i}, {}, work);
      ASSERT_LE(d.lower, brute.most + brute.uncovered + 1);
      ASSERT_GE(d.upper, brute.most - 1);
      ASSERT_LE(d.upper - d.lower, std::max(8.1, 0.0002 * d.upper));
      deepest = std::max(deepest, d.value);
      const auto [ta, tb] = crossing.crossing_segments()[i];
      const auto place = places->region_of_pair(ta, tb);
      ASSERT_TRUE(place);
      by_place[*place] = std::max(by_place[*place], d.value);
      const Vec3d middle = (curve.segments[i][0] + curve.segments[i][1]) * 0.5;
      ASSERT_EQ(places->region_of({.of_a = true, .triangle = ta, .point = middle}), place);
    }
    const Depth whole = crossing.depth({}, work);
    ASSERT_NEAR(whole.value, deepest, std::max(8.1, 0.0002 * deepest));
    if (!by_place.empty()) {
      ASSERT_EQ(*std::ranges::max_element(by_place), deepest);
    }
  }
  EXPECT_GT(several, 10);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SheetDepths, test::seeds<std::uint64_t>(2));

}  // namespace
}  // namespace strake::geometry
