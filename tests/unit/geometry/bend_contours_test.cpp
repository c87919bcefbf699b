// SPDX-License-Identifier: Apache-2.0
// The nets of bends for an eye anywhere outside them have their contours.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

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

TEST(BendContours, FromLowOverItsPlaneAreEdges) {
  PrimitiveDraw draw(21);
  for (int i = 0; i < test::rounds(60); ++i) {
    SCOPED_TRACE(i);
    const CircularTorusPrimitive bend = some_bend(draw, i);
    const Vec3d eye = low_eye(draw, bend, i);
    const Tessellation t = tessellate_from(eye, bend, {}, kSag);
    ASSERT_EQ(t.fault, "");
    EXPECT_NE(t.mesh.vertices, tessellate(bend, {}, kSag).mesh.vertices);
    EXPECT_LE(t.mesh.sag_mm, 4.2 * kSag);
    // Net also expects that each edge has two facets.
    EXPECT_GE(Net(t.mesh).contours_from(eye).size(), 2U);
  }
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
