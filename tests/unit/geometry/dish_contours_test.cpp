// SPDX-License-Identifier: Apache-2.0
// The contours of dishes from an eye are edges, and lie on the true ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "geometry/numeric/trig.hpp"
#include "geometry/primitives/tessellate.hpp"
#include "support/contour_edges.hpp"
#include "support/random_primitives.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using test::loose_ends;
using test::Net;
using test::normal_at;
using test::PrimitiveDraw;
using test::worst_end_from;

/// A dish of either kind, from flat to more than half a ball.
Primitive some_dish(PrimitiveDraw& draw, int i) {
  const double radius = draw.between(10, 500);
  if (i % 2 == 0) return EllipticalDishPrimitive{radius, radius * draw.between(0.05, 1.5)};
  return SphericalDishPrimitive{radius, radius * draw.between(0.05, i % 5 == 0 ? 3 : 1)};
}

double radius_of(const Primitive& dish) {
  if (const auto* e = std::get_if<EllipticalDishPrimitive>(&dish)) return e->radius;
  return std::get<SphericalDishPrimitive>(dish).radius;
}

/// A place on the skin of a dish: `share` of the way from the base circle to the apex.
Vec3d on_dish(const Primitive& dish, double share, double turn) {
  if (const auto* e = std::get_if<EllipticalDishPrimitive>(&dish)) {
    const double r = e->radius * std::cos(share * kPi / 2);
    return {r * std::cos(turn), r * std::sin(turn), e->height * std::sin(share * kPi / 2)};
  }
  const auto& s = std::get<SphericalDishPrimitive>(dish);
  const double ball = (s.radius * s.radius / s.height + s.height) / 2;
  const double tilt = 2 * std::atan2(s.height, s.radius) * (1 - share);
  const double r = ball * std::sin(tilt);
  return {r * std::cos(turn), r * std::sin(turn), s.height - ball + ball * std::cos(tilt)};
}

/// Whether a dish looks both towards the eye and away from it, between a share of the way up and
/// the next.
bool turns_away(const Primitive& dish, double from, double to, const Vec3d& eye) {
  bool towards = false, away = false;
  for (int i = 0; i <= (from == to ? 0 : 100); ++i)
    for (int k = 0; k < 720; ++k) {
      const Vec3d p = on_dish(dish, from + (to - from) * i / 100, k * kPi / 360);
      (dot(normal_at(dish, p), eye - p) > 0 ? towards : away) = true;
    }
  return towards && away;
}

// They run from the base circle to the base circle, or round, and are left out only where they
// hardly rise over the base circle.
TEST(ContoursFromAnEye, OfADishLieOnTheTrueOnes) {
  PrimitiveDraw draw(17);
  int crossing = 0, round = 0;
  for (int i = 0; i < test::rounds(150); ++i) {
    SCOPED_TRACE(i);
    const Primitive dish = some_dish(draw, i);
    const double radius = radius_of(dish);
    Vec3d eye = draw.direction() * (radius * draw.between(1.1, i % 3 == 0 ? 4 : 40));
    if (i % 7 == 0) eye = {draw.between(-1, 1) * radius, draw.between(-1, 1) * radius, 5 * radius};
    if (i % 49 == 0) eye = {0, 0, 5 * radius};
    const Tessellation t = tessellate_from(eye, dish, {}, 0.5);
    ASSERT_EQ(t.fault, "");
    EXPECT_LE(t.mesh.sag_mm, 0.8);
    EXPECT_LT(worst_end_from(eye, dish, t), 1e-9);
    const auto contours = Net(t.mesh).contours_from(eye);
    if (contours.empty()) {
      EXPECT_FALSE(turns_away(dish, 0.13, 1, eye));
      continue;
    }
    const std::vector<Vec3d> loose = loose_ends(contours);
    EXPECT_EQ(loose.size(), turns_away(dish, 0, 0, eye) ? 2U : 0U);
    ++(loose.empty() ? round : crossing);
    for (const Vec3d& p : loose) {
      EXPECT_NEAR(p.z, 0, 1e-9);
      EXPECT_NEAR(std::hypot(p.x, p.y), radius, 1e-9);
    }
  }
  EXPECT_GT(crossing, test::rounds(75));
  EXPECT_GT(round, test::rounds(10));
}

// But for those near the contour's ends.
TEST(ContoursFromAnEye, RimsOfPipeAndDishMeet) {
  PrimitiveDraw draw(18);
  std::size_t met = 0, missed = 0;
  for (int i = 0; i < test::rounds(200); ++i) {
    const double radius = draw.between(20, 600), height = radius * draw.between(0.1, 1);
    const Primitive dish = i % 2 == 0 ? Primitive(SphericalDishPrimitive{radius, height})
                                      : Primitive(EllipticalDishPrimitive{radius, height});
    const Vec3d eye = draw.direction() * (radius * draw.between(1.5, 40));
    const Tessellation t = tessellate_from(eye, dish, {}, 0.5);
    const Tessellation pipe =
        tessellate_from(eye + Vec3d{0, 0, 500}, CylinderPrimitive{radius, 1000}, {}, 0.5);
    const test::RimMeeting rims = test::rims_of(t, pipe, 1e-6);
    met += rims.met;
    missed += rims.missed;
    EXPECT_LE(rims.missed, i % 2 == 0 ? 2U : 0U) << i;
  }
  EXPECT_GT(met, 20 * missed);
}

/// How far the facets of a dish are from its ball, at most, but for those of its base.
double distance_from_ball(const SphericalDishPrimitive& dish, const TriangleMesh& mesh) {
  const double ball = (dish.radius * dish.radius / dish.height + dish.height) / 2;
  const Vec3d centre{0, 0, dish.height - ball};
  double farthest = 0;
  for (const Triangle& w : mesh.triangles) {
    const auto &a = mesh.vertices[w[0]], &b = mesh.vertices[w[1]], &c = mesh.vertices[w[2]];
    if (std::max({a.z, b.z, c.z}) < 1e-9 * dish.height) continue;
    constexpr int kParts = 6;
    for (int i = 0; i <= kParts; ++i)
      for (int k = 0; i + k <= kParts; ++k) {
        const Vec3d p = (a * i + b * k + c * (kParts - i - k)) * (1.0 / kParts) - centre;
        farthest = std::max(farthest, std::fabs(std::sqrt(dot(p, p)) - ball));
      }
  }
  return farthest;
}

TEST(Contours, OfMoreThanHalfABallKeepTheSag) {
  PrimitiveDraw draw(19);
  for (int i = 0; i < test::rounds(60); ++i) {
    SCOPED_TRACE(i);
    const double radius = draw.between(10, 500);
    const SphericalDishPrimitive dish{radius, radius * draw.between(1, i % 4 == 0 ? 12 : 3)};
    const double ball = (radius * radius / dish.height + dish.height) / 2;
    const Vec3d towards = draw.direction();
    const Vec3d eye = Vec3d{0, 0, dish.height - ball} + towards * (ball * draw.between(1.05, 20));
    for (const bool is_eye : {false, true}) {
      const Tessellation t =
          is_eye ? tessellate_from(eye, dish, {}, 0.5) : tessellate(dish, {}, 0.5, towards);
      EXPECT_LE(t.mesh.sag_mm, 0.75);
      EXPECT_LE(distance_from_ball(dish, t.mesh), t.mesh.sag_mm + 1e-6);
      // In one direction as from an eye, all that can be seen of a ball has its contour.
      const auto contours = is_eye ? Net(t.mesh).contours_from(eye) : Net(t.mesh).contours(towards);
      EXPECT_GE(contours.size(), 8U);
    }
  }
}

}  // namespace
}  // namespace strake::geometry
