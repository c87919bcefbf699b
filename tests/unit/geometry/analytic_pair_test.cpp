// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/analytic_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace strake::geometry {
namespace {

constexpr double kPerMm = 1000;
const Mat3d kTurn{{Vec3d{-2.0 / 3, 2.0 / 15, 11.0 / 15}, Vec3d{2.0 / 3, -1.0 / 3, 2.0 / 3},
                   Vec3d{1.0 / 3, 14.0 / 15, 2.0 / 15}}};

AnalyticSeparation of(const Primitive& a, const Vec3d& at_a, const Primitive& b, const Vec3d& at_b,
                      const Mat3d& turn = {}) {
  const Placement pa{turn, at_a}, pb{turn, at_b};
  const auto s = analytic_separation({&a, &pa}, {&b, &pb});
  EXPECT_TRUE(s);
  return s.value_or(AnalyticSeparation{});
}

TEST(AnalyticPair, Spheres) {
  const SpherePrimitive large{200}, small{60};
  EXPECT_NEAR(of(large, {}, small, {150, 0, 0}).d, 20'000, 1e-3);
  EXPECT_NEAR(of(large, {}, small, {125, 0, 0}).d, -5'000, 1e-3);
  // Wholly inside: as deep as the large sphere's centre, when the small one holds it.
  EXPECT_NEAR(of(large, {}, small, {10, 0, 0}).d, -100'000, 1e-3);
  const AnalyticSeparation nested = of(large, {}, small, {50, 0, 0});
  EXPECT_NEAR(nested.d, -80'000, 1e-3);
  EXPECT_NEAR(nested.b_inside_a, 20'000, 1e-3);
  EXPECT_LT(nested.a_inside_b, 0);
  EXPECT_NEAR(nested.point.x, 20'000, 1e-3);
  EXPECT_EQ(of(large, {}, large, {}).difference, 0);
}

TEST(AnalyticPair, ParallelCylinders) {
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

TEST(AnalyticPair, OthersHaveNoClosedForm) {
  const Primitive ball = SpherePrimitive{100}, pipe = CylinderPrimitive{50, 100};
  const Placement here, askew{{{Vec3d{1, 0, 0}, Vec3d{0, 0.6, -0.8}, Vec3d{0, 0.8, 0.6}}}, {}};
  const Placement oval{{{Vec3d{2, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}}, {}};
  EXPECT_FALSE(analytic_separation({&ball, &here}, {&pipe, &here}));
  EXPECT_FALSE(analytic_separation({&pipe, &here}, {&pipe, &askew}));
  EXPECT_FALSE(analytic_separation({&ball, &here}, {&ball, &oval}));
}

/// The definition by dense sampling of the plane through both axes, in any frame.
TEST(AnalyticPair, DepthIsThatOfTheDeepestSample) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](int lo, int hi) {
      return static_cast<double>(lo +
                                 static_cast<int>(random() % static_cast<std::uint64_t>(hi - lo)));
    };
    const CylinderPrimitive a{draw(10, 60), draw(20, 200)}, b{draw(10, 60), draw(20, 200)};
    const double x = draw(0, 100), z = draw(-150, 150);
    const double found = of(a, {}, b, {x, 0, z}).d / kPerMm;
    const AnalyticSeparation turned = of(a, {}, b, kTurn * Vec3d{x, 0, z}, kTurn);
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
