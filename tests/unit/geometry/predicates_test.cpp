// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/predicates.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <random>

namespace strake::geometry {
namespace {

mpz_class det(const Vec3l& a, const Vec3l& b, const Vec3l& c) {
  const auto z = [](std::int64_t v) { return mpz_class(std::to_string(v)); };
  return z(a.x) * (z(b.y) * z(c.z) - z(b.z) * z(c.y)) -
         z(a.y) * (z(b.x) * z(c.z) - z(b.z) * z(c.x)) +
         z(a.z) * (z(b.x) * z(c.y) - z(b.y) * z(c.x));
}

mpz_class as_mpz(Int128 v) {
  const WideInt<2> wide(v);
  mpz_class r;
  mpz_import(r.get_mpz_t(), 2, -1, sizeof(std::uint64_t), 0, 0, wide.limbs().data());
  if (wide.negative()) r -= mpz_class(1) << 128;
  return r;
}

class PredicatesTest : public testing::TestWithParam<std::uint64_t> {
 protected:
  std::mt19937_64 rng{GetParam()};

  std::int64_t within(std::int64_t size) {
    const auto span = static_cast<std::uint64_t>(2 * size + 1);
    return static_cast<std::int64_t>(rng() % span) - size;
  }
  Vec3l point(std::int64_t size) { return {within(size), within(size), within(size)}; }
};

TEST_P(PredicatesTest, Orient3dIsTheExactSign) {
  for (int i = 0; i < 20000; ++i) {
    const std::int64_t size = std::int64_t{1} << (2 + rng() % 29);
    const Vec3l a = point(size), b = point(size), c = point(size);
    Vec3l p = point(size);
    // Half of the points in or next to the plane: combinations of the three, off by a unit or two.
    if (i % 2 == 0) {
      const std::int64_t s = within(3), t = within(3);
      p = a + (b - a) * s + (c - a) * t + point(i % 4 == 0 ? 0 : 2);
      if (std::abs(p.x) > size || std::abs(p.y) > size || std::abs(p.z) > size) continue;
    }
    const mpz_class exact = det(b - a, c - a, p - a);
    ASSERT_EQ(orient3d(a, b, c, p), sgn(exact));
    ASSERT_EQ(as_mpz(det_exact(b - a, c - a, p - a)), exact);
  }
}

TEST_P(PredicatesTest, ExtremeCornersOfTheRange) {
  const std::int64_t big = std::int64_t{1} << 30;
  for (int i = 0; i < 20000; ++i) {
    const auto corner = [&] {
      const auto pick = [&] { return (rng() % 2 == 0 ? -big : big) + within(1); };
      return Vec3l{pick(), pick(), pick()};
    };
    const Vec3l a = corner(), b = corner(), c = corner(), p = corner();
    ASSERT_EQ(orient3d(a, b, c, p), sgn(det(b - a, c - a, p - a)));
    for (int axis = 0; axis < 3; ++axis) {
      Vec3l unit;
      unit[axis] = 1;
      ASSERT_EQ(orient2d(a, b, c, axis), sgn(det(b - a, c - a, unit)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PredicatesTest, testing::Values(1, 2, 3));

}  // namespace
}  // namespace strake::geometry
