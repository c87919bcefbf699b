// SPDX-License-Identifier: Apache-2.0
#include "geometry/numeric/trig.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace strake::geometry {
namespace {

/// Distance in units in the last place of the larger number.
double ulps(double a, double b) {
  if (a == b) return 0;
  const double size = std::max({std::fabs(a), std::fabs(b), 1e-300});
  const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return std::fabs(a - b) / ulp;
}

TEST(Trig, SineAndCosineAgreeWithTheLibraryWithinThreeUlps) {
  std::mt19937_64 random(1);
  for (const double range : {1e-9, 0.1, 1.0, 7.0, 1e3, 1e6}) {
    std::uniform_real_distribution<double> angle(-range, range);
    for (int i = 0; i < 20000; ++i) {
      const double x = angle(random);
      const SinCos sc = sin_cos(x);
      ASSERT_LE(ulps(sc.sin, std::sin(x)), 3) << x;
      ASSERT_LE(ulps(sc.cos, std::cos(x)), 3) << x;
    }
  }
}

TEST(Trig, MultiplesOfAQuarterTurnKeepTheirRelativeAccuracy) {
  for (int k = -4000; k <= 4000; ++k) {
    const double x = k * (kPi / 2);
    EXPECT_LE(ulps(sin_cos(x).sin, std::sin(x)), 3) << k;
    EXPECT_LE(ulps(sin_cos(x).cos, std::cos(x)), 3) << k;
  }
}

TEST(Trig, ArcTangentAgreesWithTheLibraryWithinThreeUlps) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int i = 0; i < 50000; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 60) - 30);
    const double x = coordinate(random) * scale, y = coordinate(random);
    ASSERT_LE(ulps(arc_tan2(y, x), std::atan2(y, x)), 3) << y << ' ' << x;
  }
  EXPECT_EQ(arc_tan2(0, 0), 0);
  EXPECT_EQ(arc_tan2(0, -1), kPi);
  EXPECT_EQ(arc_tan2(0, 1), 0);
}

TEST(Trig, ArcCosineAndSineAgreeWithTheLibraryWithinFourUlps) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int i = 0; i < 50000; ++i) {
    const double x = value(random);
    ASSERT_LE(ulps(arc_cos(x), std::acos(x)), 4) << x;
    ASSERT_LE(ulps(arc_sin(x), std::asin(x)), 4) << x;
  }
  EXPECT_EQ(arc_cos(1), 0);
  EXPECT_EQ(arc_cos(-1), kPi);
}

TEST(Trig, NonsenseGivesNotANumber) {
  EXPECT_TRUE(std::isnan(sin_cos(std::numeric_limits<double>::infinity()).sin));
  EXPECT_TRUE(std::isnan(sin_cos(1e7).cos));
  EXPECT_TRUE(std::isnan(arc_cos(1.0000001)));
  EXPECT_TRUE(std::isnan(arc_tan2(std::nan(""), 1)));
}

// The bits themselves: any compiler, any machine.
TEST(Trig, BitsAreFixed) {
  std::uint64_t h = 0;
  const auto mix = [&h](double v) {
    h = (h ^ std::bit_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 29U;
  };
  for (int i = -2000; i < 2000; ++i) {
    const double x = i * 0.01 + 0.003;
    mix(sin_cos(x).sin);
    mix(sin_cos(x).cos);
    mix(arc_tan2(x, 1.7));
    mix(arc_cos(x / 21));
  }
  EXPECT_EQ(h, 9400131345123852631ULL);
}

TEST(Trig, UnitCircleIsExactlySymmetric) {
  for (int n = 4; n <= 400; n += 4) {
    const auto c = unit_circle(n);
    const int q = n / 4;
    const auto at = [&](int k) { return c[static_cast<std::size_t>((k + 2 * n) % n)]; };
    EXPECT_EQ(at(0).cos, 1);
    EXPECT_EQ(at(q).sin, 1);
    EXPECT_EQ(at(q).cos, 0);
    for (int k = 0; k < n; ++k) {
      EXPECT_EQ(at(k).sin, -at(-k).sin);
      EXPECT_EQ(at(k).cos, at(-k).cos);
      EXPECT_EQ(at(k).cos, at(q - k).sin);
      EXPECT_NEAR(at(k).sin, std::sin(2 * kPi * k / n), 3e-15);
    }
  }
}

TEST(Trig, SegmentsKeepTheSagAndAreFewest) {
  for (const double radius : {0.3, 5.0, 57.15, 1000.0, 25000.0})
    for (const double sag : {0.01, 0.375, 2.0}) {
      const int n = circle_segments(radius, sag);
      EXPECT_EQ(n % 4, 0);
      EXPECT_GE(n, 8);
      EXPECT_LE(sagitta(radius, 2 * kPi / n), sag);
      if (n > 8) {
        EXPECT_GT(sagitta(radius, 2 * kPi / (n - 4)), sag);
      }
      const int m = arc_segments(radius, 1.5, sag);
      EXPECT_LE(sagitta(radius, 1.5 / m), sag);
      if (m > 1) {
        EXPECT_GT(sagitta(radius, 1.5 / (m - 1)), sag);
      }
    }
  EXPECT_EQ(circle_segments(1e9, 1e-9, 1024), 1024);
  EXPECT_EQ(circle_segments(0, 1), 8);
}

}  // namespace
}  // namespace strake::geometry
