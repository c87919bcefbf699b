// SPDX-License-Identifier: Apache-2.0
// Pairs that have no closed form, at a separation known by construction.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "strake/geometry/primitive_separation.hpp"
#include "support/random_primitives.hpp"

namespace strake::geometry {
namespace {

using test::PrimitiveDraw;

constexpr double kUnitsPerMm = 1000;

/// b placed in a's frame, both in a turned and shifted one; what the snap moves is at most 2 units.
PrimitiveSeparation of(const Primitive& a, const Primitive& b, const Placement& b_in_a,
                       std::uint64_t seed) {
  PrimitiveDraw draw(seed);
  const Placement frame{draw.turn(), draw.point(1000)};
  const Placement placed = frame * b_in_a;
  const auto s = iterative_separation({&a, &frame}, {&b, &placed});
  const auto swapped = iterative_separation({&b, &placed}, {&a, &frame});
  EXPECT_TRUE(s && swapped);
  if (!s || !swapped) return {};
  EXPECT_NEAR(s->d, swapped->d, s->error() + swapped->error());
  return *s;
}

void expect_d(const PrimitiveSeparation& s, double mm, const std::string& what,
              double width = 0.5) {
  EXPECT_NEAR(s.d, mm * kUnitsPerMm, s.error() + 2) << what;
  EXPECT_LE((s.upper - s.lower) / 2, width) << what;
}

const Mat3d kUpsideDown{{Vec3d{1, 0, 0}, Vec3d{0, -1, 0}, Vec3d{0, 0, -1}}};
/// Local z along the world's x.
const Mat3d kOnItsSide{{Vec3d{0, 0, 1}, Vec3d{0, 1, 0}, Vec3d{-1, 0, 0}}};

TEST(PrimitiveSolvers, DishOverAPlate) {
  const Primitive plate = BoxPrimitive{2000, 2000, 20}, dish = EllipticalDishPrimitive{400, 150},
                  cap = SphericalDishPrimitive{400, 150};
  for (const double d : {-15.0, -3.0, -0.2, 0.2, 4.0, 90.0})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const std::string what = std::to_string(seed) + " d " + std::to_string(d);
      // The apex points at the plate; deeper than half the plate would be measured in the dish.
      const Placement at{kUpsideDown, {30, -70, 10 + 150 + d}};
      if (d > -10) expect_d(of(plate, dish, at, seed), d, "dish " + what);
      if (d > -10) expect_d(of(plate, cap, at, seed), d, "cap " + what);
      // The rim first.
      const Placement flat{{}, {30, -70, 10 + d}};
      if (d > -10) expect_d(of(plate, dish, flat, seed), d, "rim " + what);
    }
}

TEST(PrimitiveSolvers, ConeOnAPlane) {
  const Primitive plate = BoxPrimitive{2000, 2000, 400};
  SnoutPrimitive cone;
  cone.bottom_radius = 120;
  cone.height = 300;
  cone.offset_x = 80;
  for (const double d : {-60.0, -5.0, -0.1, 0.1, 2.0, 30.0})
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
      expect_d(of(plate, cone, {kUpsideDown, {0, 0, 200 + 150 + d}}, seed), d,
               std::to_string(seed) + " d " + std::to_string(d));
}

TEST(PrimitiveSolvers, CrossedPipes) {
  const Primitive thick = CylinderPrimitive{200, 4000}, thin = CylinderPrimitive{50, 3000};
  for (const double d : {-49.0, -12.0, -0.3, 0.3, 7.0, 400.0})
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
      expect_d(of(thick, thin, {kOnItsSide, {0, 250 + d, 100}}, seed), d,
               std::to_string(seed) + " d " + std::to_string(d));
  // Through the middle: the deepest point is the common one of both axes, in the thick pipe.
  expect_d(of(thick, thin, {kOnItsSide, {0, 0, 100}}, 1), -200, "through");
}

TEST(PrimitiveSolvers, PipeThroughAWall) {
  const Primitive wall = BoxPrimitive{3000, 3000, 200}, pipe = CylinderPrimitive{60, 1500};
  // Deepest in the wall's middle plane, a plateau; a fat pipe is deeper in itself.
  expect_d(of(wall, pipe, {{}, {200, 300, 0}}, 3), -100, "thin");
  expect_d(of(wall, CylinderPrimitive{260, 1500}, {{}, {200, 300, 0}}, 3), -260, "fat");
}

TEST(PrimitiveSolvers, SphereBesideAnObliqueCone) {
  // Generator of the cone opposite to its offset: from (-100, 0, -150) to (-100 + 60, 0, 150).
  SnoutPrimitive snout;
  snout.bottom_radius = 100;
  snout.top_radius = 40;
  snout.height = 300;
  const Vec3d normal = Vec3d{300, 0, 60} * (1 / std::sqrt(300.0 * 300 + 60 * 60));
  for (const double d : {-8.0, -0.5, 0.5, 12.0})
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
      expect_d(of(snout, SpherePrimitive{60}, {{}, Vec3d{70, 0, 0} + normal * (30 + d)}, seed), d,
               std::to_string(seed) + " d " + std::to_string(d));
}

TEST(PrimitiveSolvers, MitredPipesMeetAlongTheirCut) {
  SnoutPrimitive pipe;
  pipe.bottom_radius = pipe.top_radius = 80;
  pipe.height = 600;
  pipe.top_shear_x = 0.4;
  SnoutPrimitive next = pipe;
  next.top_shear_x = 0;
  next.bottom_shear_x = 0.4;
  const double slope = std::tan(0.4), part = std::sqrt(1 + slope * slope);
  for (const double d : {-4.0, -0.5, 0.5, 6.0})
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
      expect_d(of(pipe, next, {{}, {0, 0, 600 + d * part}}, seed), d,
               std::to_string(seed) + " d " + std::to_string(d));
}

TEST(PrimitiveSolvers, NestedAndEqual) {
  const Primitive drum = CylinderPrimitive{500, 1000}, rod = CylinderPrimitive{20, 300},
                  dish = EllipticalDishPrimitive{100, 50};
  // A rod askew in a drum: inside by what is left to the nearer end.
  const Mat3d askew{{Vec3d{0.8, 0, 0.6}, Vec3d{0, 1, 0}, Vec3d{-0.6, 0, 0.8}}};
  const PrimitiveSeparation in = of(drum, rod, {askew, {0, 0, 300}}, 5);
  EXPECT_NEAR(in.b_inside_a, (200 - (150 * 0.8 + 20 * 0.6)) * kUnitsPerMm, 3);
  EXPECT_LT(in.a_inside_b, 0);
  const PrimitiveSeparation under = of(drum, dish, {{}, {0, 0, 450}}, 5);
  EXPECT_NEAR(under.b_inside_a, 0, 3);
  const PrimitiveSeparation same = of(dish, dish, {}, 5);
  EXPECT_LE(same.difference, 1);
  // The dish's deepest point: the centre of the largest ball between base and dome.
  EXPECT_NEAR(same.d, -25 * kUnitsPerMm, 1);
}

TEST(PrimitiveSolvers, SheetsAreMeasuredInTheOther) {
  const Primitive disc = CylinderPrimitive{100, 0}, wall = BoxPrimitive{400, 400, 50};
  const PrimitiveSeparation across = of(wall, disc, {kOnItsSide, {0, 0, 0}}, 2);
  expect_d(across, -25, "across");
  EXPECT_TRUE(across.sheet_b);
  expect_d(of(wall, disc, {{}, {10, 20, 15}}, 2), -10, "within");
  expect_d(of(wall, disc, {{}, {10, 20, 32}}, 2), 7, "above");
  const Placement here;
  EXPECT_FALSE(iterative_separation({&disc, &here}, {&disc, &here})) << "two sheets that meet";
}

const CircularTorusPrimitive kElbow{600, 100, 1.2};

TEST(PrimitiveSolvers, SphereAtAnElbow) {
  const double t = 0.5;
  for (const double d : {-40.0, -6.0, -0.3, 0.3, 8.0, 150.0})
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const std::string what = std::to_string(seed) + " d " + std::to_string(d);
      // Outside, inside and above the bend.
      for (const double side : {1.0, -1.0}) {
        const double out = 600 + side * (100 + 50 + d);
        expect_d(
            of(kElbow, SpherePrimitive{100}, {{}, {out * std::cos(t), out * std::sin(t), 0}}, seed),
            d, "beside " + what);
      }
      expect_d(of(kElbow, SpherePrimitive{100},
                  {{}, {600 * std::cos(t), 600 * std::sin(t), 150 + d}}, seed),
               d, "above " + what);
      // Before the start.
      if (d > -50)
        expect_d(of(kElbow, SpherePrimitive{100}, {{}, {610, -50 - d, 20}}, seed), d,
                 "before " + what);
    }
}

TEST(PrimitiveSolvers, CylinderBesideATorusTube) {
  const CircularTorusPrimitive ring{500, 80, 6.283185307179586};
  for (const double d : {-30.0, -2.0, 0.4, 9.0})
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const std::string what = std::to_string(seed) + " d " + std::to_string(d);
      // Parallel to the ring's plane across its top, then upright outside and in its hole.
      const CylinderPrimitive pipe{40, 3000};
      expect_d(of(ring, pipe, {kOnItsSide, {0, 500, 80 + 40 + d}}, seed), d, "across " + what);
      expect_d(of(ring, pipe, {{}, {500 + 80 + 40 + d, 0, 0}}, seed), d, "outside " + what);
      expect_d(of(ring, pipe, {{}, {500 - 80 - 40 - d, 0, 0}}, seed), d, "inside " + what);
    }
}

TEST(PrimitiveSolvers, RectangularBendBesideABox) {
  const RectangularTorusPrimitive bend{300, 500, 200, 1.0};
  const BoxPrimitive box{100, 60, 40};
  for (const double d : {-15.0, -1.5, 0.5, 20.0})
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const std::string what = std::to_string(seed) + " d " + std::to_string(d);
      const Vec3d out{std::cos(0.5), std::sin(0.5), 0}, along{-std::sin(0.5), std::cos(0.5), 0};
      const Mat3d turned{{Vec3d{out.x, along.x, 0}, Vec3d{out.y, along.y, 0}, Vec3d{0, 0, 1}}};
      // Flat face against the outer wall, edges against the inner wall, on top, before the start.
      expect_d(of(bend, box, {turned, out * (500 + 50 + d)}, seed), d, "outside " + what);
      const double reach = std::sqrt((300 - d) * (300 - d) - 30 * 30);
      if (d > 0) expect_d(of(bend, box, {turned, out * (reach - 50)}, seed), d, "inside " + what);
      expect_d(of(bend, box, {turned, out * 400 + Vec3d{0, 0, 100 + 20 + d}}, seed), d,
               "above " + what);
      expect_d(of(bend, box, {{}, {400, -30 - d, 10}}, seed), d, "before " + what);
    }
}

TEST(PrimitiveSolvers, LinkedRingsAndElbowsEndToEnd) {
  const CircularTorusPrimitive ring{500, 50, 6.283185307179586};
  // Links of a chain: the tube of one in the middle of the other's hole.
  const Mat3d upright{{Vec3d{1, 0, 0}, Vec3d{0, 0, -1}, Vec3d{0, 1, 0}}};
  // Every half-plane of the one sees the other alike: the work limit leaves the bracket wide.
  expect_d(of(ring, ring, {upright, {500, 0, 0}}, 4), 400, "linked", 2000);
  expect_d(of(ring, ring, {upright, {90, 0, 0}}, 4), -10, "chained", 50);
  expect_d(of(ring, ring, {upright, {1100 + 7, 0, 0}}, 4), 7, "apart");
  // An elbow, and the pipe that goes on where it starts.
  const CylinderPrimitive pipe{100, 800};
  const Mat3d along_y{{Vec3d{1, 0, 0}, Vec3d{0, 0, 1}, Vec3d{0, -1, 0}}};
  for (const double d : {-4.0, -0.5, 0.0, 0.7, 12.0})
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
      expect_d(of(kElbow, pipe, {along_y, {600, -400 - d, 0}}, seed), d,
               std::to_string(seed) + " d " + std::to_string(d));
  const PrimitiveSeparation in = of(kElbow, CircularTorusPrimitive{600, 70, 1.0}, {}, 3);
  expect_d(in, -100, "one bend in another");
  EXPECT_LT(in.a_inside_b, 0);
  EXPECT_NEAR(in.b_inside_a, 0, 3) << "flush at the start";
}

}  // namespace
}  // namespace strake::geometry
