// SPDX-License-Identifier: Apache-2.0
#include "geometry/distance/triangle_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "strake/geometry/triangle_contact.hpp"
#include "strake/geometry/wide_int.hpp"
#include "support/draw.hpp"
#include "support/rounds.hpp"

namespace strake::geometry {
namespace {

using test::Draw;

constexpr double kAll = std::numeric_limits<double>::infinity();

double exact(const TriangleCorners& a, const TriangleCorners& b, double upper) {
  const SquaredDistance squared = exact_triangle_distance(a, b, upper).squared;
  return ratio_to_double(squared.numerator, squared.denominator);
}

/// With area; of a few steps, so that many lie in one plane, have corners in common or cross.
TriangleCorners drawn_triangle(Draw& draw, std::int32_t step, const Vec3l& at) {
  for (;;) {
    TriangleCorners t;
    for (Vec3l& p : t)
      p = at + Vec3l{draw.whole(-3, 4) * step, draw.whole(-3, 4) * step, draw.whole(-1, 2) * step};
    if (cross_exact(t[1] - t[0], t[2] - t[0]) != Vec3<Int128>{}) return t;
  }
}

TEST(TriangleDistanceTest, BoundsHoldTheExactDistanceWhateverIsRequested) {
  std::size_t meeting = 0, beyond = 0, within = 0;
  for (std::uint64_t seed = 1; seed <= test::rounds(20'000U, 2'000'000U); ++seed) {
    SCOPED_TRACE(seed);
    Draw draw(seed);
    const std::int32_t step = draw.one_in(2) ? 1 : draw.whole(2, 100'000'000);
    const TriangleCorners a = drawn_triangle(draw, step, {});
    const TriangleCorners b = drawn_triangle(draw, step, {draw.whole(0, 4) * step, 0, 0});
    const DoubleTriangle x(a), y(b);
    const DistanceBounds all = triangle_distance_bounds(x, y, kAll);
    const double squared = exact(a, b, all.upper);
    constexpr double kMore = 1 + 0x1p-40;
    ASSERT_LE(all.lower, squared * kMore);
    ASSERT_GE(all.upper * kMore, squared);
    const double reach = draw.between(0, 4) * step, limit = reach * reach;
    const DistanceBounds some = triangle_distance_bounds(x, y, limit, limit);
    ASSERT_LE(some.lower, squared * kMore);
    ASSERT_GE(some.upper * kMore, squared);
    if (some.lower > limit)
      ++beyond;
    else if (some.upper <= limit)
      ++within;
    if (contact(ExactTriangle(a), ExactTriangle(b)).touch == Touch::none) continue;
    ++meeting;
    ASSERT_LE(std::sqrt(all.upper), 1e-12 * step) << "a side of the one meets the other";
  }
  EXPECT_GT(meeting, test::rounds(1'000U, 100'000U));
  EXPECT_GT(within, test::rounds(5'000U, 500'000U));
  EXPECT_GT(beyond, test::rounds(3'000U, 300'000U));
}

}  // namespace
}  // namespace strake::geometry
