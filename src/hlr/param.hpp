// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "strake/geometry/wide_int.hpp"

namespace strake::hlr {

/// The nearest double; most are short, and far faster converted as such.
[[nodiscard]] inline double rounded(geometry::Int128 x) {
  const auto low = static_cast<std::int64_t>(x);
  return low == x ? static_cast<double>(low) : static_cast<double>(x);
}

/// An exact parameter in [0, 1] on an edge, num / den (den > 0, not reduced), with its double.
struct Param {
  geometry::Int128 num = 0, den = 1;
  double value = 0;

  [[nodiscard]] static Param of(geometry::Int128 num, geometry::Int128 den) {
    return {num, den, rounded(num) / rounded(den)};
  }
  [[nodiscard]] static Param zero() { return {}; }
  [[nodiscard]] static Param one() { return {1, 1, 1}; }
};

/// -1, 0 or 1, exact. Each double is off by at most 3.1·2^-53, so a difference of 2^-50 decides.
[[nodiscard]] inline int compare(const Param& x, const Param& y) {
  constexpr double kCertain = 8.9e-16;
  const double difference = x.value - y.value;
  if (difference > kCertain) return 1;
  if (difference < -kCertain) return -1;
  if (x.num == y.num && x.den == y.den) return 0;
  const auto left = geometry::mul(x.num, y.den), right = geometry::mul(y.num, x.den);
  return left < right ? -1 : right < left ? 1 : 0;
}
[[nodiscard]] inline bool less(const Param& x, const Param& y) { return compare(x, y) < 0; }

/// floor(delta·t + 1/2), exact: the same for every fraction that stands for the same t.
[[nodiscard]] inline std::int64_t rounded_share(std::int64_t delta, const Param& t) {
  const double guess = t.value * static_cast<double>(delta) + 0.5;
  const double margin = std::fabs(static_cast<double>(delta)) * 1e-15 + 1e-9;
  const double low = std::floor(guess - margin);
  if (low == std::floor(guess + margin)) return static_cast<std::int64_t>(low);
  // k is right when (2k - 1)·den <= 2·delta·num < (2k + 1)·den.
  auto k = static_cast<std::int64_t>(low);
  const auto twice = geometry::mul(geometry::Int128{2} * delta, t.num);
  while (!(twice < geometry::mul(geometry::Int128{2} * k + 1, t.den))) ++k;
  return k;
}

}  // namespace strake::hlr
