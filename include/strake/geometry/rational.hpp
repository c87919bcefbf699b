// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <limits>

#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {

/// An exact parameter along a line, num / den, not reduced; den > 0, or 0 for the two infinities
/// (num -1 or 1) at which rays and lines end.
struct Rational {
  Int128 num = 0, den = 1;

  /// Returns the nearest double.
  [[nodiscard]] double value() const {
    if (den != 0) return ratio_to_double(num, den);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return num < 0 ? -kInfinity : kInfinity;
  }
  friend constexpr std::strong_ordering operator<=>(const Rational& x, const Rational& y) {
    if (x.den == 0 && y.den == 0) return x.num <=> y.num;
    return compare_fractions(x.num, x.den, y.num, y.den);
  }
  friend constexpr bool operator==(const Rational& x, const Rational& y) { return (x <=> y) == 0; }
};

/// An exact point in grid units, numerator / denominator, not reduced; the denominator is positive.
/// Numerators have N limbs of 64 bits.
template <std::size_t N>
struct BasicRationalPoint {
  Vec3<WideInt<N>> numerator;
  Int192 denominator = Int192(Int128{1});

  BasicRationalPoint() = default;
  BasicRationalPoint(const Vec3<WideInt<N>>& n, const Int192& d) : numerator(n), denominator(d) {}
  explicit BasicRationalPoint(const Vec3l& p)
      : numerator{WideInt<N>(Int128{p.x}), WideInt<N>(Int128{p.y}), WideInt<N>(Int128{p.z})} {}

  /// Returns each coordinate rounded to the nearest double.
  [[nodiscard]] Vec3d value() const {
    return {ratio_to_double(numerator.x, denominator), ratio_to_double(numerator.y, denominator),
            ratio_to_double(numerator.z, denominator)};
  }
  /// Returns each coordinate rounded to the nearest grid unit, ties away from zero. The coordinates
  /// fit 63 bits.
  [[nodiscard]] Vec3l rounded() const {
    return {round_div(numerator.x, denominator), round_div(numerator.y, denominator),
            round_div(numerator.z, denominator)};
  }
  /// Whether both are the same point, in whatever fractions.
  friend bool operator==(const BasicRationalPoint& p, const BasicRationalPoint& q) {
    for (int k = 0; k < 3; ++k)
      if (compare_fractions(p.numerator[k], p.denominator, q.numerator[k], q.denominator) != 0)
        return false;
    return true;
  }
};

/// In results of the exact tests, numerators are below 2^182, denominators below 2^128.
using RationalPoint = BasicRationalPoint<3>;
/// The point of three planes: numerators are below 2^240, denominators below 2^189.
using WideRationalPoint = BasicRationalPoint<4>;

/// Returns from + direction · num / den, exactly; den > 0, and the result within the bounds above.
template <std::size_t N, std::size_t M>
[[nodiscard]] RationalPoint point_along(const Vec3l& from, const Vec3<Int128>& direction,
                                        const WideInt<N>& num, const WideInt<M>& den) {
  RationalPoint r;
  for (int k = 0; k < 3; ++k)
    r.numerator[k] = narrow<3>(mul(WideInt<2>(Int128{from[k]}), den)) +
                     narrow<3>(mul(WideInt<2>(direction[k]), num));
  r.denominator = narrow<3>(WideInt<M + 1>(den));
  return r;
}

/// A squared distance in square grid units: an exact rational, numerator below 2^200 and
/// denominator below 2^136.
struct SquaredDistance {
  Int256 numerator;
  Int192 denominator = Int192(Int128{1});

  /// Returns the distance, rounded to the nearest double.
  [[nodiscard]] double distance() const { return sqrt_ratio_to_double(numerator, denominator); }
  [[nodiscard]] bool zero() const { return numerator.sign() == 0; }

  friend std::strong_ordering operator<=>(const SquaredDistance& x, const SquaredDistance& y) {
    return mul(x.numerator, y.denominator) <=> mul(y.numerator, x.denominator);
  }
  friend bool operator==(const SquaredDistance& x, const SquaredDistance& y) {
    return (x <=> y) == 0;
  }
};

}  // namespace strake::geometry
