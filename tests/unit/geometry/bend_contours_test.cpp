// SPDX-License-Identifier: Apache-2.0
// The nets of bends for an eye anywhere outside them: their contours, and which way facets look.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geometry/numeric/trig.hpp"
#include "geometry/primitives/tessellate.hpp"
#include "support/bend_surface.hpp"
#include "support/contour_edges.hpp"
#include "support/random_primitives.hpp"
#include "support/rounds.hpp"

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

/// Half the sum, over the facets that look the wrong way, of their areas on paper at the eye's
/// distance. What lies on the contour's one side has corners that look towards the eye or along it.
double wrong_area(const BendSurface& surface, const TriangleMesh& mesh) {
  const double angle = std::min(surface.bend.angle, 2 * kPi);
  double area = 0;
  for (const Triangle& w : mesh.triangles) {
    double facing = 0;
    bool is_cap = true;
    for (const std::uint32_t k : w) {
      const auto [sweep, place] = surface.angles_of(mesh.vertices[k]);
      facing += surface.facing(sweep, place);
      is_cap = is_cap && (std::fabs(sweep) < 1e-9 || std::fabs(sweep - angle) < 1e-9);
    }
    const Vec3d &a = mesh.vertices[w[0]], sight = test::unit(surface.eye - a);
    const double seen = dot(cross(mesh.vertices[w[1]] - a, mesh.vertices[w[2]] - a), sight);
    if (!is_cap && seen * facing < 0) area += std::fabs(seen) / 2;
  }
  return area;
}

TEST(BendContours, FromLowOverItsPlaneFewFacetsLookTheWrongWay) {
  PrimitiveDraw draw(21);
  double wrong = 0, wrong_in_scene = 0;
  for (int i = 0; i < test::rounds(100); ++i) {
    SCOPED_TRACE(i);
    const CircularTorusPrimitive bend = some_bend(draw, i);
    const Vec3d eye = low_eye(draw, bend, i);
    const BendSurface surface{bend, eye};
    const Tessellation t = tessellate_from(eye, bend, {}, kSag), plain = tessellate(bend, {}, kSag);
    ASSERT_EQ(t.fault, "");
    EXPECT_NE(t.mesh.vertices, plain.mesh.vertices);
    EXPECT_LE(t.mesh.sag_mm, 4.2 * kSag);
    EXPECT_GE(Net(t.mesh).contours_from(eye).size(), 2U);
    const double size = 1 / (bend.tube_radius * bend.tube_radius);
    wrong += wrong_area(surface, t.mesh) * size;
    wrong_in_scene += wrong_area(surface, plain.mesh) * size;
  }
  std::printf("wrong %.3f of %.3f\n", wrong, wrong_in_scene);
  EXPECT_LT(wrong, wrong_in_scene / 3);
}

// The sections have vertices where the true contour is, high over its plane and low.
TEST(BendContours, ArePlacesOfVertices) {
  const CircularTorusPrimitive bend{225, 150, kPi / 2};
  for (const double elevation_deg : {-30.0, -7.0, 0.5, 2.0, 4.0, 8.0, 12.0, 45.0}) {
    SCOPED_TRACE(elevation_deg);
    const double rise = std::sqrt(2.0) * std::tan(elevation_deg * kPi / 180);
    const BendSurface surface{bend, Vec3d{1, -1, rise} * 8000};
    const Tessellation t = tessellate_from(surface.eye, bend, {}, kSag);
    std::size_t on_contour = 0;
    for (const Vec3d& v : t.mesh.vertices) {
      const auto [sweep, place] = surface.angles_of(v);
      if (std::fabs(surface.facing(sweep, place)) < 1e-9) ++on_contour;
    }
    EXPECT_GE(on_contour, 20U);
  }
}

}  // namespace
}  // namespace strake::geometry
