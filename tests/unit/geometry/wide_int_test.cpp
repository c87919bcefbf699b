// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/wide_int.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <random>

#include "support/nearest_double.hpp"

namespace strake::geometry {
namespace {

using test::nearest_double;

template <std::size_t N>
mpz_class big(const WideInt<N>& v) {
  mpz_class r;
  mpz_import(r.get_mpz_t(), N, -1, sizeof(std::uint64_t), 0, 0, v.limbs().data());
  if (v.negative()) r -= mpz_class(1) << (64 * N);
  return r;
}

/// Random, with a random number of significant bits and runs of equal bits, where carries hide.
template <std::size_t N>
WideInt<N> random_wide(std::mt19937_64& rng, int max_bits) {
  typename WideInt<N>::Limbs limbs{};
  const std::uint64_t pattern = rng() % 4;
  for (auto& limb : limbs) limb = pattern == 0 ? 0 : pattern == 1 ? ~std::uint64_t{0} : rng();
  limbs[0] ^= rng();
  const int bits = 1 + static_cast<int>(rng() % static_cast<std::uint64_t>(max_bits));
  for (int i = bits; i < static_cast<int>(64 * N); ++i)
    limbs[static_cast<std::size_t>(i / 64)] &= ~(std::uint64_t{1} << (i % 64));
  const WideInt<N> v(limbs);
  return rng() % 2 == 0 ? v : -v;
}

template <std::size_t N>
WideInt<N> random_positive(std::mt19937_64& rng, int max_bits) {
  const WideInt<N> v = random_wide<N>(rng, max_bits);
  return v.sign() == 0 ? WideInt<N>(Int128{1}) : v.negative() ? -v : v;
}

mpz_class power_of_two(int bits) { return mpz_class(1) << static_cast<unsigned>(bits); }

class WideIntTest : public testing::TestWithParam<std::uint64_t> {
 protected:
  std::mt19937_64 rng{GetParam()};
};

TEST_P(WideIntTest, ArithmeticEqualsGmp) {
  for (int i = 0; i < 4000; ++i) {
    const auto a = random_wide<3>(rng, 190), b = random_wide<3>(rng, 190);
    const auto c = random_wide<4>(rng, 255);
    ASSERT_EQ(big(a + b), big(a) + big(b));
    ASSERT_EQ(big(a - b), big(a) - big(b));
    ASSERT_EQ(big(-a), -big(a));
    ASSERT_EQ(big(mul(a, c)), big(a) * big(c));
    ASSERT_EQ(big(mul(c, a)), big(a) * big(c));
    ASSERT_EQ(big(WideInt<8>(a)), big(a));
    ASSERT_EQ(a.sign(), sgn(big(a)));
    ASSERT_EQ(a < b, big(a) < big(b));
    ASSERT_EQ(a == b, big(a) == big(b));
    ASSERT_EQ(narrow<3>(WideInt<8>(a)), a);
  }
}

TEST_P(WideIntTest, FractionsCompareExactly) {
  for (int i = 0; i < 4000; ++i) {
    const auto n1 = random_wide<2>(rng, 100), n2 = random_wide<2>(rng, 100);
    const auto d1 = random_positive<2>(rng, 100), d2 = random_positive<2>(rng, 100);
    const mpq_class q1(big(n1), big(d1)), q2(big(n2), big(d2));
    const auto order = compare_fractions(n1, d1, n2, d2);
    ASSERT_EQ(order < 0, big(n1) * big(d2) < big(n2) * big(d1));
    // The same rational, not reduced.
    const Int128 k = static_cast<Int128>(rng() >> 40);
    const auto narrow_n = random_wide<2>(rng, 60), narrow_d = random_positive<2>(rng, 60);
    const auto kn = narrow<2>(mul(narrow_n, WideInt<2>(k + 1)));
    const auto kd = narrow<2>(mul(narrow_d, WideInt<2>(k + 1)));
    ASSERT_TRUE(compare_fractions(kn, kd, narrow_n, narrow_d) == 0);
  }
}

TEST_P(WideIntTest, QuotientsRoundLikeGmp) {
  for (int i = 0; i < 4000; ++i) {
    const auto d = random_positive<3>(rng, 190);
    const auto q = random_wide<2>(rng, 62);
    const auto r = random_positive<3>(rng, 190);
    // A dividend with a quotient of at most 62 bits, on and off the ties.
    const WideInt<5> n = mul(q, d) + (rng() % 2 == 0 ? WideInt<5>{} : WideInt<5>(r));
    const mpz_class bn = big(n), bd = big(d);
    mpz_class floor;
    mpz_fdiv_q(floor.get_mpz_t(), bn.get_mpz_t(), bd.get_mpz_t());
    if (abs(floor) < power_of_two(62)) {
      ASSERT_EQ(mpz_class(std::to_string(floor_div(n, d))), floor);
      const mpz_class twice = 2 * abs(bn) + bd, divisor = 2 * bd;
      mpz_class rounded = twice / divisor;
      if (bn < 0) rounded = -rounded;
      ASSERT_EQ(mpz_class(std::to_string(round_div(n, d))), rounded);
    }
  }
  EXPECT_EQ(round_div(Int128{5}, Int128{2}), 3);
  EXPECT_EQ(round_div(Int128{-5}, Int128{2}), -3);
  EXPECT_EQ(floor_div(Int128{-5}, Int128{2}), -3);
  EXPECT_EQ(round_div(Int128{-1}, Int128{3}), 0);
}

TEST_P(WideIntTest, RatiosRoundToNearestDouble) {
  for (int i = 0; i < 4000; ++i) {
    const auto n = random_wide<6>(rng, 380);
    const auto d = random_positive<4>(rng, 250);
    const mpq_class q(big(n), big(d));
    mpq_class reduced = q;
    reduced.canonicalize();
    ASSERT_EQ(ratio_to_double(n, d), nearest_double(reduced));
    ASSERT_EQ(ratio_to_double(n, WideInt<2>(Int128{1})), nearest_double(mpq_class(big(n))));
  }
  // Exactly half way between two doubles: to even.
  const Int128 tie = (Int128{1} << 53) + 1;
  EXPECT_EQ(ratio_to_double(tie, Int128{1}), 9007199254740992.0);
  EXPECT_EQ(ratio_to_double(tie + 2, Int128{1}), 9007199254740996.0);
}

TEST_P(WideIntTest, RootsRoundToNearestDouble) {
  for (int i = 0; i < 2000; ++i) {
    const auto n = random_positive<6>(rng, 340);
    const auto d = random_positive<3>(rng, 140);
    const double root = sqrt_ratio_to_double(n, d);
    const mpq_class q(big(n), big(d));
    const mpq_class low = (mpq_class(root) + mpq_class(std::nextafter(root, 0.0))) / 2;
    const mpq_class high = (mpq_class(root) + mpq_class(std::nextafter(root, INFINITY))) / 2;
    ASSERT_LE(low * low * big(d), big(n));
    ASSERT_GE(high * high * big(d), big(n));
  }
  EXPECT_EQ(sqrt_ratio_to_double(WideInt<2>(Int128{49}), WideInt<2>(Int128{4})), 3.5);
}

INSTANTIATE_TEST_SUITE_P(Seeds, WideIntTest, testing::Values(1, 2, 3));

}  // namespace
}  // namespace strake::geometry
