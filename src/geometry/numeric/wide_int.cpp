// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/wide_int.hpp"

#include <bit>
#include <cmath>

namespace strake::geometry::detail {
namespace {

/// An unsigned number in a fixed buffer: room for a 640-bit value shifted up by 64 + 640 bits.
constexpr std::size_t kRoom = 24;

struct Magnitude {
  std::array<std::uint64_t, kRoom> limb{};
  std::size_t size = 0;  ///< limbs in use; the highest is not zero

  void trim() {
    while (size > 0 && limb[size - 1] == 0) --size;
  }
  [[nodiscard]] int bits() const {
    return size == 0 ? 0 : static_cast<int>(64 * size) - std::countl_zero(limb[size - 1]);
  }
};

bool is_negative(std::span<const std::uint64_t> v) { return (v.back() >> 63) != 0; }

Magnitude magnitude(std::span<const std::uint64_t> v) {
  Magnitude m;
  const bool negative = is_negative(v);
  std::uint64_t carry = negative ? 1 : 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::uint64_t limb = (negative ? ~v[i] : v[i]) + carry;
    carry = (carry != 0 && limb == 0) ? 1 : 0;
    m.limb[i] = limb;
  }
  m.size = v.size();
  m.trim();
  return m;
}

Magnitude shifted_up(const Magnitude& m, int bits) {
  const auto limbs = static_cast<std::size_t>(bits / 64);
  const int rest = bits % 64;
  Magnitude r;
  r.size = m.size + limbs + 1;
  for (std::size_t i = 0; i < m.size; ++i) {
    r.limb[i + limbs] |= m.limb[i] << rest;
    if (rest != 0) r.limb[i + limbs + 1] |= m.limb[i] >> (64 - rest);
  }
  r.trim();
  return r;
}

int compare(const Magnitude& a, const Magnitude& b) {
  if (a.size != b.size) return a.size < b.size ? -1 : 1;
  for (std::size_t i = a.size; i-- > 0;)
    if (a.limb[i] != b.limb[i]) return a.limb[i] < b.limb[i] ? -1 : 1;
  return 0;
}

Magnitude product(const Magnitude& a, const Magnitude& b) {
  Magnitude r;
  for (std::size_t i = 0; i < a.size; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.size; ++j) {
      const UInt128 t = static_cast<UInt128>(a.limb[i]) * b.limb[j] + r.limb[i + j] + carry;
      r.limb[i + j] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    r.limb[i + b.size] += carry;
  }
  r.size = a.size + b.size;
  r.trim();
  return r;
}

struct Division {
  Magnitude quotient;
  Magnitude remainder;  ///< scaled by a power of two: for comparison with zero and with the divisor
  Magnitude divisor;    ///< scaled likewise
};

/// Takes q·v off u[at .. at + v.size]; true when the result went below zero.
bool subtract_multiple(Magnitude& u, const Magnitude& v, std::uint64_t q, std::size_t at) {
  std::uint64_t carry = 0, borrow = 0;
  for (std::size_t i = 0; i <= v.size; ++i) {
    const UInt128 t = static_cast<UInt128>(q) * (i < v.size ? v.limb[i] : 0) + carry;
    carry = static_cast<std::uint64_t>(t >> 64);
    const UInt128 d = static_cast<UInt128>(u.limb[at + i]) - static_cast<std::uint64_t>(t) - borrow;
    u.limb[at + i] = static_cast<std::uint64_t>(d);
    borrow = static_cast<std::uint64_t>(d >> 64) & 1;
  }
  return borrow != 0;
}

void add_back(Magnitude& u, const Magnitude& v, std::size_t at) {
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i <= v.size; ++i) {
    const UInt128 t = static_cast<UInt128>(u.limb[at + i]) + (i < v.size ? v.limb[i] : 0) + carry;
    u.limb[at + i] = static_cast<std::uint64_t>(t);
    carry = static_cast<std::uint64_t>(t >> 64);
  }
}

/// Long division by 64-bit digits (Knuth, The Art of Computer Programming 2, 4.3.1, algorithm D).
Division divide(const Magnitude& n, const Magnitude& d) {
  const int shift = std::countl_zero(d.limb[d.size - 1]);
  Division r;
  r.divisor = shifted_up(d, shift);
  r.remainder = shifted_up(n, shift);
  const Magnitude& v = r.divisor;
  Magnitude& u = r.remainder;
  if (u.size < v.size) return r;
  const std::uint64_t top = v.limb[v.size - 1];
  r.quotient.size = u.size - v.size + 1;
  for (std::size_t at = r.quotient.size; at-- > 0;) {
    const std::uint64_t high = u.limb[at + v.size];
    const UInt128 head = (static_cast<UInt128>(high) << 64) | u.limb[at + v.size - 1];
    // At most two too large, since the top bit of the divisor is set.
    std::uint64_t q = high >= top ? ~std::uint64_t{0} : static_cast<std::uint64_t>(head / top);
    if (subtract_multiple(u, v, q, at)) {
      do {
        --q;
        add_back(u, v, at);
      } while ((u.limb[at + v.size] >> 63) != 0);
    }
    r.quotient.limb[at] = q;
  }
  r.quotient.trim();
  u.trim();
  return r;
}

/// m·2^exponent rounded to nearest even; `inexact` says that the true value lies just above m.
double scaled_to_double(const Magnitude& m, bool inexact, int exponent) {
  const int excess = m.bits() - 53;
  if (excess <= 0) {
    const double low = m.size == 0 ? 0.0 : static_cast<double>(m.limb[0]);
    return std::ldexp(low, exponent);
  }
  const auto bit = [&m](int i) {
    return (m.limb[static_cast<std::size_t>(i / 64)] >> (i % 64)) & 1;
  };
  std::uint64_t mantissa = 0;
  for (int i = 0; i < 53; ++i) mantissa |= bit(excess + i) << i;
  bool sticky = inexact;
  for (int i = 0; i + 1 < excess && !sticky; ++i) sticky = bit(i) != 0;
  if (bit(excess - 1) != 0 && (sticky || (mantissa & 1) != 0)) ++mantissa;
  return std::ldexp(static_cast<double>(mantissa), exponent + excess);
}

double positive_quotient(const Magnitude& n, const Magnitude& d) {
  // At least 55 bits of quotient, so that rounding sees a guard bit and the remainder is sticky.
  const int up = std::max(0, 56 - (n.bits() - d.bits()));
  const Division division = divide(shifted_up(n, up), d);
  return scaled_to_double(division.quotient, division.remainder.size != 0, -up);
}

/// Compares (mantissa·2^exponent)² with n/d.
int compare_square(std::uint64_t mantissa, int exponent, const Magnitude& n, const Magnitude& d) {
  Magnitude m;
  m.limb[0] = mantissa;
  m.size = 1;
  Magnitude left = product(product(m, m), d), right = n;
  if (exponent >= 0)
    left = shifted_up(left, 2 * exponent);
  else
    right = shifted_up(right, -2 * exponent);
  return compare(left, right);
}

std::int64_t signed_value(std::uint64_t magnitude, bool negative) {
  return static_cast<std::int64_t>(negative ? ~magnitude + 1 : magnitude);
}

}  // namespace

std::int64_t round_quotient(std::span<const std::uint64_t> n, std::span<const std::uint64_t> d) {
  Division division = divide(magnitude(n), magnitude(d));
  const Magnitude twice = shifted_up(division.remainder, 1);
  std::uint64_t q = division.quotient.size == 0 ? 0 : division.quotient.limb[0];
  if (compare(twice, division.divisor) >= 0) ++q;
  return signed_value(q, is_negative(n));
}

std::int64_t floor_quotient(std::span<const std::uint64_t> n, std::span<const std::uint64_t> d) {
  const Division division = divide(magnitude(n), magnitude(d));
  std::uint64_t q = division.quotient.size == 0 ? 0 : division.quotient.limb[0];
  if (is_negative(n) && division.remainder.size != 0) ++q;
  return signed_value(q, is_negative(n));
}

double quotient_to_double(std::span<const std::uint64_t> n, std::span<const std::uint64_t> d) {
  const Magnitude m = magnitude(n);
  if (m.size == 0) return 0;
  const double value = positive_quotient(m, magnitude(d));
  return is_negative(n) ? -value : value;
}

double sqrt_quotient_to_double(std::span<const std::uint64_t> n, std::span<const std::uint64_t> d) {
  const Magnitude num = magnitude(n), den = magnitude(d);
  if (num.size == 0) return 0;
  const double guess = std::sqrt(positive_quotient(num, den));
  // The guess is within one unit of the last place; the exact midpoints to its neighbours decide.
  int exponent = 0;
  auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(guess, &exponent), 53));
  exponent -= 54;
  if (compare_square(2 * mantissa + 1, exponent, num, den) < 0)
    ++mantissa;
  else if (compare_square(2 * mantissa - 1, exponent, num, den) > 0)
    --mantissa;
  return std::ldexp(static_cast<double>(mantissa), exponent + 1);
}

}  // namespace strake::geometry::detail
