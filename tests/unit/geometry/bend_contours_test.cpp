// SPDX-License-Identifier: Apache-2.0
// The contours of bends from an eye anywhere outside them are edges, lie on the true ones, and none
// is missing; no facet on either side of them looks the wrong way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "geometry/numeric/trig.hpp"
#include "geometry/primitives/tessellate.hpp"
#include "support/bend_surface.hpp"
#include "support/contour_edges.hpp"
#include "support/random_primitives.hpp"
#include "support/rounds.hpp"
#include "support/true_surface.hpp"

namespace strake::geometry {
namespace {

using test::BendSurface;
using test::Net;
using test::PrimitiveDraw;

constexpr double kSag = 0.5;

CircularTorusPrimitive some_bend(PrimitiveDraw& draw, int i) {
  const double tube = draw.between(10, 200);
  const double angle = i % 4 == 0 ? 2 * kPi : i % 4 == 1 ? kPi / 2 : draw.between(0.2, 6);
  return {tube * draw.between(1.2, 5), tube, angle};
}

/// An eye from low over the plane of a bend, in it, or as high as its top.
Vec3d low_eye(PrimitiveDraw& draw, const CircularTorusPrimitive& bend, int i) {
  const double outer = bend.centre_radius + bend.tube_radius;
  const double away = outer * draw.between(1.5, i % 3 == 0 ? 200 : 20), turn = draw.between(-4, 4);
  double up = away * draw.between(-0.2, 0.2);
  if (i % 10 == 3) up = 0;
  if (i % 10 == 5) up = bend.tube_radius;
  if (i % 10 == 7) up = bend.tube_radius * draw.between(-1, 1);
  return {away * std::cos(turn), away * std::sin(turn), up};
}

double distance_to(const Vec3d& p, const std::vector<std::pair<Vec3d, Vec3d>>& edges) {
  double nearest = 1e300;
  for (const auto& [a, b] : edges) {
    const Vec3d along = b - a;
    const double t = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
    const Vec3d off = p - a - along * t;
    nearest = std::min(nearest, std::sqrt(dot(off, off)));
  }
  return nearest;
}

struct Measured {
  double worst_end = 0;      ///< of a contour's ends, as a sine
  double farthest = 0;       ///< of points of the true contour from the net's
  std::size_t wrong = 0;     ///< facets that look the wrong way
  double wrong_height = 0;   ///< and how wide they are on paper
};

Measured measure(const BendSurface& surface, const Tessellation& t, double aside) {
  Measured m;
  const auto is_aside = [&](double sweep) {
    const double out = surface.eye.x * std::cos(sweep) + surface.eye.y * std::sin(sweep) -
                       surface.bend.centre_radius;
    return std::fabs(out) > aside;
  };
  const auto edges = Net(t.mesh).contours_from(surface.eye);
  for (const auto& [a, b] : edges)
    for (const Vec3d& p : {a, b}) {
      const auto [sweep, place] = surface.angles_of(p);
      if (is_aside(sweep)) m.worst_end = std::max(m.worst_end, std::fabs(surface.facing(sweep, place)));
    }
  const double angle = std::min(surface.bend.angle, 2 * kPi);
  for (int k = 1; k < 400; ++k) {
    const double sweep = angle * k / 400;
    const auto places = surface.contour(sweep);
    if (!places || !is_aside(sweep)) continue;
    for (const double place : {places->first, places->second})
      m.farthest = std::max(m.farthest, distance_to(surface.at(sweep, place), edges));
  }
  for (const Triangle& w : t.mesh.triangles) {
    const auto& v = t.mesh.vertices;
    double facing = 0, largest = 0;
    bool is_cap = true;
    for (const std::uint32_t k : w) {
      const auto [sweep, place] = surface.angles_of(v[k]);
      const double here = surface.facing(sweep, place);
      facing += here;
      largest = std::max(largest, std::fabs(here));
      is_cap = is_cap && (std::fabs(sweep) < 1e-9 || std::fabs(sweep - angle) < 1e-9);
    }
    if (is_cap) continue;
    const Vec3d a = v[w[0]], n = cross(v[w[1]] - a, v[w[2]] - a), sight = surface.eye - a;
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d e = v[w[(k + 1) % 3]] - v[w[k]];
      longest = std::max(longest, std::sqrt(dot(e, e)));
    }
    const double height = dot(n, sight) / std::sqrt(dot(sight, sight)) / longest;
    if (height * facing >= 0 || std::fabs(height) < 5e-3) continue;
    ++m.wrong;
    m.wrong_height = std::max(m.wrong_height, std::fabs(height));
  }
  return m;
}

TEST(BendContours, FromLowOverItsPlaneLieOnTheTrueOnes) {
  PrimitiveDraw draw(21);
  int bent = 0, kept = 0;
  for (int i = 0; i < test::rounds(400); ++i) {
    SCOPED_TRACE(i);
    const CircularTorusPrimitive bend = some_bend(draw, i);
    const Vec3d eye = low_eye(draw, bend, i);
    const BendSurface surface{bend, eye};
    const Tessellation t = tessellate_from(eye, bend, {}, kSag);
    ASSERT_EQ(t.fault, "");
    const bool is_scene = t.mesh.vertices == tessellate(bend, {}, kSag).mesh.vertices;
    ++(is_scene ? kept : bent);
    // Where the eye sees the tube along, a circle may stand for the contour.
    const double turning = bend.tube_radius + std::fabs(eye.z);
    const double level = std::hypot(eye.x, eye.y);
    const bool at_once = (bend.centre_radius + bend.tube_radius) * turning * turning /
                             (2 * (level * level - bend.centre_radius * bend.centre_radius)) <
                         kSag / 8;
    const Measured m = measure(surface, t, at_once ? 2 * turning : 0);
    std::printf("%3d R %.0f r %.0f a %.2f eye %.0f %.2f(deg) %s%s n %zu sag %.2f end %.1e far %.2f wrong %zu %.3f\n", i,
                bend.centre_radius, bend.tube_radius, bend.angle, level,
                std::atan2(eye.z, level) * 180 / kPi, is_scene ? "SCENE " : "",
                at_once ? "once" : "", t.mesh.triangles.size(), t.mesh.sag_mm, m.worst_end, m.farthest, m.wrong,
                m.wrong_height);
  }
  std::printf("bent %d kept %d\n", bent, kept);
}

}  // namespace
}  // namespace strake::geometry
