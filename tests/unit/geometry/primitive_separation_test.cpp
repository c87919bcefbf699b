// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/primitive_separation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <variant>

#include "support/rotations.hpp"

namespace strake::geometry {
namespace {

using test::kTurn;

constexpr double kPerMm = 1000;

PrimitiveSeparation of(const Primitive& a, const Vec3d& at_a, const Primitive& b, const Vec3d& at_b,
                       const Mat3d& turn = {}) {
  const Placement pa{turn, at_a}, pb{turn, at_b};
  const auto s = primitive_separation({&a, &pa}, {&b, &pb});
  EXPECT_TRUE(s);
  return s.value_or(PrimitiveSeparation{});
}

TEST(PrimitiveSeparationTest, Spheres) {
  const SpherePrimitive large{200}, small{60};
  EXPECT_NEAR(of(large, {}, small, {150, 0, 0}).d, 20'000, 1e-3);
  EXPECT_NEAR(of(large, {}, small, {125, 0, 0}).d, -5'000, 1e-3);
  // Wholly inside: as deep as the large sphere's centre, when the small one holds it.
  EXPECT_NEAR(of(large, {}, small, {10, 0, 0}).d, -100'000, 1e-3);
  const PrimitiveSeparation nested = of(large, {}, small, {50, 0, 0});
  EXPECT_NEAR(nested.d, -80'000, 1e-3);
  EXPECT_NEAR(nested.b_inside_a, 20'000, 1e-3);
  EXPECT_LT(nested.a_inside_b, 0);
  EXPECT_NEAR(nested.point.x, 20'000, 1e-3);
  EXPECT_EQ(of(large, {}, large, {}).difference, 0);
}

TEST(PrimitiveSeparationTest, ParallelCylinders) {
  const CylinderPrimitive pipe{50, 1000}, thin{20, 400};
  EXPECT_NEAR(of(pipe, {}, thin, {80, 0, 0}).d, 10'000, 1e-3);
  EXPECT_NEAR(of(pipe, {}, thin, {0, 0, 730}).d, 30'000, 1e-3);
  EXPECT_NEAR(of(pipe, {}, thin, {100, 0, 740}).d, 50'000, 1e-3);
  EXPECT_NEAR(of(pipe, {}, thin, {65, 0, 0}).d, -5'000, 1e-3);
  // End to end, 7 mm into each other.
  EXPECT_NEAR(of(pipe, {}, thin, {0, 0, -693}).d, -7'000, 1e-3);
  EXPECT_NEAR(of(pipe, {}, thin, {10, 0, 100}).d, -50'000, 1e-3);
  EXPECT_NEAR(of(pipe, {}, thin, {10, 0, 100}).b_inside_a, 20'000, 1e-3);
}

TEST(PrimitiveSeparationTest, SphereAndBox) {
  const SpherePrimitive ball{200};
  const BoxPrimitive box{400, 600, 1000};
  // Over a face, an edge and a corner.
  EXPECT_NEAR(of(box, {}, ball, {307, 50, -80}).d, 7'000, 1e-3);
  EXPECT_NEAR(of(box, {}, ball, {200 + 63, 300 + 84, 10}).d, 5'000, 1e-3);
  EXPECT_NEAR(of(box, {}, ball, {200 + 30, 300 + 60, -500 - 60}).d, -10'000, 1e-3);
  EXPECT_NEAR(of(box, {}, ball, {200 + 60, 300 + 120, 500 + 120}).d, 80'000, 1e-3);
  EXPECT_NEAR(of(ball, {}, box, {-292, 0, 0}).d, -8'000, 1e-3);
  // Inside: as deep as the box's middle plane, when the ball reaches it.
  const PrimitiveSeparation in = of(box, {}, ball, {50, 0, 0});
  EXPECT_NEAR(in.d, -200'000, 1e-3);
  EXPECT_NEAR(in.b_inside_a, 50'000, 1e-3);
  EXPECT_LT(in.a_inside_b, 0);
  EXPECT_NEAR(of(box, {}, SpherePrimitive{40}, {150, 0, 0}).d, -70'000, 1e-3);
  // The ball holds the box: as deep as the ball's centre.
  const PrimitiveSeparation held = of(SpherePrimitive{3000}, {}, box, {500, 0, 0});
  EXPECT_NEAR(held.d, -1'200'000, 1e-3);
  EXPECT_NEAR(held.b_inside_a, 1'500'000 - 1'000 * std::sqrt(700 * 700 + 300 * 300 + 500 * 500),
              1e-3);
}

TEST(PrimitiveSeparationTest, SphereAndCylinder) {
  const SpherePrimitive ball{200};
  const CylinderPrimitive pipe{50, 1000};
  EXPECT_NEAR(of(pipe, {}, ball, {90, 120, 300}).d, 0, 1e-3);
  EXPECT_NEAR(of(pipe, {}, ball, {0, 160, 300}).d, 10'000, 1e-3);
  EXPECT_NEAR(of(pipe, {}, ball, {20, 20, -605}).d, 5'000, 1e-3);
  EXPECT_NEAR(of(pipe, {}, ball, {0, 50 + 66, 500 + 88}).d, 10'000, 1e-3);
  EXPECT_NEAR(of(ball, {}, pipe, {0, 0, 590}).d, -10'000, 1e-3);
  EXPECT_NEAR(of(ball, {}, pipe, {}).d, -100'000, 1e-3);
  EXPECT_NEAR(of(pipe, {}, SpherePrimitive{20}, {20, 0, 0}).d, -40'000, 1e-3);
  EXPECT_NEAR(of(pipe, {}, SpherePrimitive{20}, {20, 0, 0}).b_inside_a, 20'000, 1e-3);
}

/// In any frame and either order: what a dense sampling of the definition finds.
TEST(PrimitiveSeparationTest, SpheresInBodiesAreAsDeepAsTheDeepestSample) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](int lo, int hi) {
      return static_cast<double>(lo +
                                 static_cast<int>(random() % static_cast<std::uint64_t>(hi - lo)));
    };
    const double r = draw(5, 60);
    const bool pipe = seed % 2 == 0;
    const BoxPrimitive box{draw(10, 90), draw(10, 90), draw(10, 90)};
    const CylinderPrimitive cylinder{draw(5, 45), draw(10, 90)};
    const Primitive body = pipe ? Primitive{cylinder} : Primitive{box};
    const Vec3d at{draw(-80, 80), draw(-80, 80), draw(-80, 80)};
    const PrimitiveSeparation s = of(body, {}, SpherePrimitive{2 * r}, at);
    EXPECT_EQ(of(SpherePrimitive{2 * r}, at, body, {}).d, s.d) << "seed " << seed;
    EXPECT_NEAR(of(body, {}, SpherePrimitive{2 * r}, kTurn * at, kTurn).d, s.d, 2) << seed;
    const auto depth = [&](const Vec3d& p) {
      const double side =
          pipe ? cylinder.radius - std::sqrt(p.x * p.x + p.y * p.y)
               : std::min(box.length_x / 2 - std::fabs(p.x), box.length_y / 2 - std::fabs(p.y));
      return std::min(side, (pipe ? cylinder.height : box.length_z) / 2 - std::fabs(p.z));
    };
    double deepest = -1, nearest = 1e9;
    for (double x = -45; x <= 45; x += 3)
      for (double y = -45; y <= 45; y += 3)
        for (double z = -45; z <= 45; z += 3) {
          const Vec3d p{x, y, z}, off = p - at;
          const double to_centre = std::sqrt(dot(off, off)), in_body = depth(p);
          if (in_body >= 0) nearest = std::min(nearest, to_centre - r);
          if (in_body >= 0 && to_centre <= r) deepest = std::max({deepest, in_body, r - to_centre});
        }
    EXPECT_LE(deepest, std::max(0.0, -s.d / kPerMm) + 1e-9) << "seed " << seed;
    if (s.d < -6 * kPerMm) {
      EXPECT_GE(deepest, -s.d / kPerMm - 5.2) << "seed " << seed;
    }
    if (s.d > 0) {
      EXPECT_GE(nearest, s.d / kPerMm - 1e-9) << "seed " << seed;
      EXPECT_LE(nearest, s.d / kPerMm + 5.2) << "seed " << seed;
    }
  }
}

TEST(PrimitiveSeparationTest, RoundingOfMatricesIsPartOfTheError) {
  // Single precision, as RVM files have it.
  Mat3d rough = kTurn;
  for (Vec3d& row : rough.row)
    for (int k = 0; k < 3; ++k) row[k] = static_cast<double>(static_cast<float>(row[k]));
  const Primitive pipe = CylinderPrimitive{100, 6000}, ball = SpherePrimitive{200};
  const Placement p{rough, {}}, q{kTurn, kTurn * Vec3d{215, 0, 4000}}, r{rough, {350, 0, 0}};
  const auto pipes = primitive_separation({&pipe, &p}, {&pipe, &q});
  ASSERT_TRUE(pipes);
  EXPECT_NEAR(pipes->d, 15'000, pipes->error() + 2);
  EXPECT_GT(pipes->error(), 0);
  EXPECT_LT(pipes->error(), 4);
  const auto balls = primitive_separation({&ball, &p}, {&ball, &r});
  ASSERT_TRUE(balls);
  EXPECT_NEAR(balls->d, 150'000, balls->error());
  EXPECT_LT(balls->error(), 0.1);
}

TEST(PrimitiveSeparationTest, ScalesThatLeaveTheKindAsItIs) {
  const Primitive box = BoxPrimitive{100, 100, 100}, pipe = CylinderPrimitive{50, 100},
                  ball = SpherePrimitive{20};
  const Placement tall{{{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 3}}}, {}};
  const Placement above{{}, {0, 0, 170}};
  EXPECT_NEAR(primitive_separation({&box, &tall}, {&ball, &above})->d, 10'000, 1e-3);
  EXPECT_NEAR(primitive_separation({&pipe, &tall}, {&ball, &above})->d, 10'000, 1e-3);
  EXPECT_NEAR(primitive_separation({&ball, &tall}, {&ball, &above})->d, 130'000, 0.1)
      << "an ellipsoid";
  const Placement oval{{{Vec3d{2, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}}, {}};
  const Placement beside{{}, {113, 0, 0}};
  EXPECT_NEAR(primitive_separation({&pipe, &oval}, {&ball, &beside})->d, 3'000, 0.1);
  const Placement sheared{{{Vec3d{1, 0.1, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}}, {}};
  EXPECT_NEAR(primitive_separation({&box, &sheared}, {&ball, &beside})->d,
              63'000 / std::sqrt(1.01) - 10'000, 0.1);
  const Placement flat{{{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 0}}}, {}};
  EXPECT_FALSE(primitive_separation({&box, &flat}, {&ball, &above}));
}

TEST(PrimitiveSeparationTest, LinesAndWedgedSnoutsHaveNone) {
  const Primitive pipe = CylinderPrimitive{50, 100}, line = LinePrimitive{0, 100};
  SnoutPrimitive cut;
  cut.bottom_radius = cut.top_radius = 50;
  cut.height = 30;
  cut.top_shear_x = 0.7;
  const Primitive wedge = cut;
  const Placement here;
  EXPECT_FALSE(primitive_separation({&pipe, &here}, {&line, &here}));
  EXPECT_FALSE(primitive_separation({&wedge, &here}, {&pipe, &here})) << "end planes meet in it";
  cut.top_shear_x = 0.5;
  const Primitive mitre = cut;
  EXPECT_TRUE(primitive_separation({&mitre, &here}, {&pipe, &here}));
}

/// Distance of a point to the skin of a body about the origin, millimetres.
double to_skin(const Primitive& body, const Vec3d& p) {
  Vec3d beyond{};
  if (const auto* ball = std::get_if<SpherePrimitive>(&body))
    return std::fabs(std::sqrt(dot(p, p)) - ball->diameter / 2);
  if (const auto* pipe = std::get_if<CylinderPrimitive>(&body)) {
    beyond = {std::sqrt(p.x * p.x + p.y * p.y) - pipe->radius, -1e9,
              std::fabs(p.z) - pipe->height / 2};
  } else {
    const auto& box = std::get<BoxPrimitive>(body);
    beyond = {std::fabs(p.x) - box.length_x / 2, std::fabs(p.y) - box.length_y / 2,
              std::fabs(p.z) - box.length_z / 2};
  }
  const double inside = std::max({beyond.x, beyond.y, beyond.z});
  if (inside <= 0) return -inside;
  for (int k = 0; k < 3; ++k) beyond[k] = std::max(0.0, beyond[k]);
  return std::sqrt(dot(beyond, beyond));
}

/// Closest points lie on both skins; a deepest point and the skin's nearest lie d apart.
TEST(PrimitiveSeparationTest, WitnessesLieWhereTheyState) {
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const auto draw = [&](int lo, int hi) {
      return static_cast<double>(lo + static_cast<int>(random() % static_cast<unsigned>(hi - lo)));
    };
    const Primitive ball = SpherePrimitive{draw(10, 120)},
                    pipe = CylinderPrimitive{draw(5, 45), draw(10, 90)},
                    box = BoxPrimitive{draw(10, 90), draw(10, 90), draw(10, 90)},
                    other = CylinderPrimitive{draw(5, 45), draw(10, 90)};
    const std::array<std::array<const Primitive*, 2>, 5> pairs{
        {{&ball, &ball}, {&ball, &pipe}, {&box, &ball}, {&pipe, &other}, {&pipe, &ball}}};
    const auto& [a, b] = pairs[seed % pairs.size()];
    const bool centred = seed % 7 == 0;
    const Vec3d at =
        centred ? Vec3d{0, 0, draw(-80, 80)} : Vec3d{draw(-80, 80), draw(-80, 80), draw(-80, 80)};
    const PrimitiveSeparation s = of(*a, {}, *b, at);
    const double d = s.d / kPerMm;
    const Vec3d point = s.point * (1 / kPerMm);
    EXPECT_NEAR(dot(s.away, s.away), 1, 1e-12);
    if (d > 0) {
      EXPECT_NEAR(to_skin(*a, point + s.away * (d / 2)), 0, 1e-6);
      EXPECT_NEAR(to_skin(*b, point - s.away * (d / 2) - at), 0, 1e-6);
    } else if (d < 0) {
      const Vec3d surface = s.deep_in_a ? point + s.away * d : point - s.away * d;
      EXPECT_NEAR(s.deep_in_a ? to_skin(*a, surface) : to_skin(*b, surface - at), 0, 1e-6);
      EXPECT_NEAR(s.deep_in_a ? to_skin(*a, point) : to_skin(*b, point - at), -d, 1e-6);
    }
  }
}

/// The definition by dense sampling of the plane through both axes, in any frame.
TEST(PrimitiveSeparationTest, DepthIsThatOfTheDeepestSample) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](int lo, int hi) {
      return static_cast<double>(lo +
                                 static_cast<int>(random() % static_cast<std::uint64_t>(hi - lo)));
    };
    const CylinderPrimitive a{draw(10, 60), draw(20, 200)}, b{draw(10, 60), draw(20, 200)};
    const double x = draw(0, 100), z = draw(-150, 150);
    const double found = of(a, {}, b, {x, 0, z}).d / kPerMm;
    const PrimitiveSeparation turned = of(a, {}, b, kTurn * Vec3d{x, 0, z}, kTurn);
    // The turned centre snaps to the grid.
    EXPECT_NEAR(turned.d / kPerMm, found, 0.002) << "seed " << seed;
    EXPECT_NEAR(of(b, {x, 0, z}, a, {}).d / kPerMm, found, 1e-6) << "seed " << seed;
    double deepest = -1;
    for (double u = -60; u <= 60; u += 0.5)
      for (double v = -100; v <= 100; v += 0.5) {
        const double in_a = std::min(a.radius - std::fabs(u), a.height / 2 - std::fabs(v));
        const double in_b = std::min(b.radius - std::fabs(u - x), b.height / 2 - std::fabs(v - z));
        if (in_a >= 0 && in_b >= 0) deepest = std::max({deepest, in_a, in_b});
      }
    if (found < 0) {
      EXPECT_NEAR(-found, deepest, 0.51) << "seed " << seed;
    } else {
      EXPECT_LE(deepest, 0) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace strake::geometry
