// SPDX-License-Identifier: Apache-2.0
#include "pictures/viewpoint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "pictures/viewpoint/candidates.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/team.hpp"
#include "support/pictured_clash.hpp"

namespace strake::pictures {
namespace {

using geometry::Vec3d;
using test::ClashModel;
using test::PicturedClash;
using test::RayShares;

/// Two bars that cross at the origin.
ClashModel bars() {
  ClashModel m;
  m.box("bar a", {-200, -40, -40}, {200, 40, 40});
  m.box("bar b", {-40, -200, -30}, {40, 200, 50});
  return m;
}

/// Walls round the origin: all six, or without the one on the side of an axis.
void add_room(ClashModel& m, double half, int open_axis = -1, double open_side = 1) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0}) {
      if (axis == open_axis && side == open_side) continue;
      Vec3d lo{-half, -half, -half}, hi{half, half, half};
      lo[axis] = side > 0 ? half + 1 : -half - 11;
      hi[axis] = lo[axis] + 10;
      m.box("wall " + std::to_string(axis) + (side > 0 ? "+" : "-"), lo, hi);
    }
}

/// What rays from the eye, or from the plane that cuts, see near the clash.
RayShares ray_shares(const PicturedClash& clash, const Subject& subject,
                     const ClashViewpoint& viewpoint) {
  const Scenery scenery = clash.scenery();
  const Vec3d toward = -viewpoint.direction;
  double from = dot(viewpoint.eye_mm - viewpoint.target_mm, toward);
  for (const ClippingPlane& plane : viewpoint.clipping_planes)
    from = std::min(from, dot(plane.point_mm - viewpoint.target_mm, toward));
  const auto triangles =
      triangles_near(scenery, Roles(*clash.contents, subject), grid_point(viewpoint.target_mm),
                     10 * viewpoint.half_height_mm);
  return test::shares_by_rays(triangles, toward, 0.75 * viewpoint.half_height_mm, from);
}

ClashViewpoint viewpoint_of(const PicturedClash& clash, const Subject& subject) {
  return choose_viewpoint(clash.scenery(), subject, {}, {}).value();
}

constexpr double kVisibleShare = 0.03;

TEST(Viewpoint, FramesAClashThatNothingHides) {
  const PicturedClash clash(bars());
  const Subject subject = clash.subject("bar a", "bar b");
  const ClashViewpoint viewpoint = viewpoint_of(clash, subject);
  EXPECT_TRUE(viewpoint.clipping_planes.empty());
  EXPECT_LT(viewpoint.direction.z, 0) << "from above";
  EXPECT_NEAR(dot(viewpoint.direction, viewpoint.direction), 1, 1e-12);
  EXPECT_NEAR(dot(viewpoint.direction, viewpoint.up), 0, 1e-12);
  EXPECT_GT(viewpoint.half_height_mm, 80);
  EXPECT_TRUE(viewpoint.box_mm.contains({viewpoint.target_mm, viewpoint.target_mm}));
  const double distance = std::sqrt(
      dot(viewpoint.eye_mm - viewpoint.target_mm, viewpoint.eye_mm - viewpoint.target_mm));
  EXPECT_NEAR(std::tan(viewpoint.field_of_view_deg / 360 * std::acos(-1.0)) * distance,
              viewpoint.half_height_mm, 1e-6);
  const RayShares rays = ray_shares(clash, subject, viewpoint);
  EXPECT_GT(rays.a, kVisibleShare);
  EXPECT_GT(rays.b, kVisibleShare);
}

TEST(Viewpoint, LooksThroughTheOpenSideOfARoom) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0}) {
      ClashModel m = bars();
      add_room(m, 230, axis, side);
      const PicturedClash clash(std::move(m));
      const Subject subject = clash.subject("bar a", "bar b");
      const ClashViewpoint viewpoint = viewpoint_of(clash, subject);
      EXPECT_TRUE(viewpoint.clipping_planes.empty()) << axis << ' ' << side;
      EXPECT_GT(-viewpoint.direction[axis] * side, 0.5) << axis << ' ' << side;
      const RayShares rays = ray_shares(clash, subject, viewpoint);
      EXPECT_GT(std::min(rays.a, rays.b), kVisibleShare) << axis << ' ' << side;
    }
}

TEST(Viewpoint, CutsAClosedRoomOpenAndReportsIt) {
  ClashModel m = bars();
  add_room(m, 230);
  const PicturedClash clash(std::move(m));
  const Subject subject = clash.subject("bar a", "bar b");
  const ClashViewpoint viewpoint = viewpoint_of(clash, subject);
  ASSERT_EQ(viewpoint.clipping_planes.size(), 1U);
  EXPECT_GT(dot(viewpoint.clipping_planes[0].normal, -viewpoint.direction), 0.999);
  const RayShares rays = ray_shares(clash, subject, viewpoint);
  EXPECT_GT(std::min(rays.a, rays.b), kVisibleShare);
}

TEST(Viewpoint, CutsWhatHoldsTheOther) {
  ClashModel m;
  m.box("tank", {-500, -500, -500}, {500, 500, 500});
  m.box("valve", {-60, -60, -60}, {60, 60, 60});
  const PicturedClash clash(std::move(m));
  const Subject subject = clash.subject("tank", "valve");
  const ClashViewpoint viewpoint = viewpoint_of(clash, subject);
  ASSERT_EQ(viewpoint.clipping_planes.size(), 1U);
  const RayShares rays = ray_shares(clash, subject, viewpoint);
  EXPECT_GT(std::min(rays.a, rays.b), 0.003);
}

TEST(Viewpoint, FindsAWayThroughACrowd) {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-900, 900), size(30, 260);
    ClashModel m = bars();
    for (int i = 0; i < 60; ++i) {
      const Vec3d lo{at(random), at(random), at(random)};
      const Vec3d hi = lo + Vec3d{size(random), size(random), size(random)};
      const geometry::Box3d near{{-210, -210, -210}, {210, 210, 210}};
      if (!near.meets({lo, hi})) m.box("crowd " + std::to_string(i), lo, hi);
    }
    const PicturedClash clash(std::move(m));
    const Subject subject = clash.subject("bar a", "bar b");
    const RayShares rays = ray_shares(clash, subject, viewpoint_of(clash, subject));
    EXPECT_GT(std::min(rays.a, rays.b), kVisibleShare);
  }
}

/// Random boxes round two bars: what is judged is what rays see, and nothing better is passed over.
TEST(Viewpoint, TheBestOfAllCandidatesIsChosen) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-400, 400), size(20, 300);
    ClashModel m = bars();
    for (int i = 0; i < 14; ++i) {
      const Vec3d lo{at(random), at(random), at(random)};
      m.box("box " + std::to_string(i), lo, lo + Vec3d{size(random), size(random), size(random)});
    }
    const PicturedClash clash(std::move(m));
    const Subject subject = clash.subject("bar a", "bar b");
    const Scenery scenery = clash.scenery();
    const clash::Pair& pair = pair_of(*clash.contents, subject.results[0]);
    const NearTriangles triangles(
        triangles_near(scenery, Roles(*clash.contents, subject), grid_point(pair.point_mm), 2000));
    const Sight sight{150, 1000};
    const auto all =
        evaluate_candidates(triangles, candidate_directions(pair.away), sight, {}).value();
    const ViewCandidate& best = best_of(all);
    for (const double cut : {1e300, 60.0, 0.0}) {
      const Sight cut_open{150, 1000, cut};
      const auto directions = candidate_directions(pair.away);
      const ViewCandidate found = find_best(triangles, directions, cut_open, {}).value().best;
      const auto evaluated = evaluate_candidates(triangles, directions, cut_open, {}).value();
      EXPECT_EQ(found.viewer, best_of(evaluated).viewer) << cut;
      EXPECT_EQ(found.rank, best_of(evaluated).rank) << cut;
    }
    for (const ViewCandidate& one : all) {
      EXPECT_GE(best.rank, one.rank);
      EXPECT_NEAR(one.rank, share_score(one.share) * direction_preference(one.viewer), 1e-12);
      const RayShares rays =
          test::shares_by_rays(triangles.all(), one.viewer, sight.half_mm, sight.eye_mm);
      const double sum = rays.a + rays.b;
      const double mean = sum == 0 ? 0 : 2 * rays.a * rays.b / sum;
      EXPECT_LE(one.share, mean + 0.06);
      EXPECT_GE(one.share, 0.2 * mean - 0.06);
    }
  }
}

TEST(Viewpoint, IsTheSameForAnyTeamAndWhateverElseThereIs) {
  const PicturedClash alone(bars());
  ClashModel more = bars();
  for (int i = 0; i < 40; ++i)
    more.box("far " + std::to_string(i), {90000.0 + i * 1000, 0, 0}, {90100.0 + i * 1000, 9, 9});
  const PicturedClash among(std::move(more));
  const ClashViewpoint expected = viewpoint_of(alone, alone.subject("bar a", "bar b"));
  for (const unsigned workers : {1U, 2U, 3U, 8U}) {
    parallel::Team team(workers);
    const auto found = choose_viewpoint(among.scenery(), among.subject("bar a", "bar b"), {},
                                        parallel::Context{.team = &team});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->eye_mm, expected.eye_mm);
    EXPECT_EQ(found->up, expected.up);
    EXPECT_EQ(found->visible_share, expected.visible_share);
  }
}

TEST(Viewpoint, RefusesWhatMakesNoSense) {
  const PicturedClash clash(bars());
  const Subject subject = clash.subject("bar a", "bar b");
  const Scenery scenery = clash.scenery();
  EXPECT_EQ(choose_viewpoint(scenery, subject, {0}, {}).error().code, ErrorCode::usage);
  EXPECT_EQ(choose_viewpoint(scenery, subject, {1, std::nan("")}, {}).error().code,
            ErrorCode::usage);
  EXPECT_EQ(choose_viewpoint(scenery, {}, {}, {}).error().code, ErrorCode::usage);
  EXPECT_EQ(choose_viewpoint(scenery, {{{0, 99}}}, {}, {}).error().code, ErrorCode::usage);
  const report::ClashContents without{clash.findings, clash.model};
  EXPECT_EQ(Scenery::of(without, {}).error().code, ErrorCode::usage);
  const std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(choose_viewpoint(scenery, subject, {}, {.stop = stop.get_token()}).error().code,
            ErrorCode::cancelled);
}

}  // namespace
}  // namespace strake::pictures
