// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

namespace strake::geometry {

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

/// A signed two's-complement integer of N 64-bit limbs (lowest first) for exact predicates.
///
/// Start here:
///
///     const Int256 a = mul(n1, d2), b = mul(n2, d1);   // Int128 x Int128, never overflows
///     if (a < b) ...
///
/// 1. mul() of WideInt<N> and WideInt<M> gives WideInt<N + M>: it cannot overflow.
/// 2. + and - wrap like unsigned integers; the caller chooses N with room for the sum.
/// 3. A narrower value converts to a wider type implicitly, never the other way round: narrow()
///    drops limbs where the caller knows that the value fits.
///
/// No allocation, no global state; every function is pure.
template <std::size_t N>
class WideInt {
 public:
  static_assert(N >= 2);
  using Limbs = std::array<std::uint64_t, N>;

  constexpr WideInt() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a widening conversion, as between built-in
  // integers
  constexpr WideInt(Int128 value) {
    limbs_[0] = static_cast<std::uint64_t>(static_cast<UInt128>(value));
    limbs_[1] = static_cast<std::uint64_t>(static_cast<UInt128>(value) >> 64);
    const std::uint64_t fill = value < 0 ? ~std::uint64_t{0} : 0;
    for (std::size_t i = 2; i < N; ++i) limbs_[i] = fill;
  }
  template <std::size_t M>
    requires(M < N)
  // NOLINTNEXTLINE(google-explicit-constructor): a widening conversion, as between built-in
  // integers
  constexpr WideInt(const WideInt<M>& other) {
    for (std::size_t i = 0; i < M; ++i) limbs_[i] = other.limbs()[i];
    const std::uint64_t fill = other.negative() ? ~std::uint64_t{0} : 0;
    for (std::size_t i = M; i < N; ++i) limbs_[i] = fill;
  }
  constexpr explicit WideInt(const Limbs& limbs) : limbs_(limbs) {}

  [[nodiscard]] constexpr const Limbs& limbs() const { return limbs_; }
  [[nodiscard]] constexpr bool negative() const { return (limbs_[N - 1] >> 63) != 0; }
  /// Returns -1, 0 or 1.
  [[nodiscard]] constexpr int sign() const {
    if (negative()) return -1;
    for (const std::uint64_t limb : limbs_)
      if (limb != 0) return 1;
    return 0;
  }

  friend constexpr WideInt operator+(const WideInt& a, const WideInt& b) {
    WideInt r;
    UInt128 carry = 0;
    for (std::size_t i = 0; i < N; ++i) {
      carry += static_cast<UInt128>(a.limbs_[i]) + b.limbs_[i];
      r.limbs_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return r;
  }
  friend constexpr WideInt operator-(const WideInt& a, const WideInt& b) {
    WideInt r;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const UInt128 d = static_cast<UInt128>(a.limbs_[i]) - b.limbs_[i] - borrow;
      r.limbs_[i] = static_cast<std::uint64_t>(d);
      borrow = static_cast<std::uint64_t>(d >> 64) & 1;
    }
    return r;
  }
  friend constexpr WideInt operator-(const WideInt& a) { return WideInt{} - a; }
  friend constexpr bool operator==(const WideInt&, const WideInt&) = default;
  friend constexpr std::strong_ordering operator<=>(const WideInt& a, const WideInt& b) {
    if (a.negative() != b.negative())
      return a.negative() ? std::strong_ordering::less : std::strong_ordering::greater;
    for (std::size_t i = N; i-- > 0;)
      if (a.limbs_[i] != b.limbs_[i]) return a.limbs_[i] <=> b.limbs_[i];
    return std::strong_ordering::equal;
  }

 private:
  Limbs limbs_{};
};

using Int192 = WideInt<3>;
using Int256 = WideInt<4>;

/// Returns the exact product.
template <std::size_t N, std::size_t M>
[[nodiscard]] constexpr WideInt<N + M> mul(const WideInt<N>& a, const WideInt<M>& b) {
  typename WideInt<N + M>::Limbs r{};
  for (std::size_t i = 0; i < N; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < M; ++j) {
      const UInt128 t = static_cast<UInt128>(a.limbs()[i]) * b.limbs()[j] + r[i + j] + carry;
      r[i + j] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    r[i + M] = carry;
  }
  // This is the unsigned product of two's complements: subtract the high halves again.
  const auto subtract_high = [&r](std::size_t from, std::span<const std::uint64_t> v) {
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const UInt128 d = static_cast<UInt128>(r[from + i]) - v[i] - borrow;
      r[from + i] = static_cast<std::uint64_t>(d);
      borrow = static_cast<std::uint64_t>(d >> 64) & 1;
    }
  };
  if (a.negative()) subtract_high(N, b.limbs());
  if (b.negative()) subtract_high(M, a.limbs());
  return WideInt<N + M>(r);
}

[[nodiscard]] constexpr Int256 mul(Int128 a, Int128 b) { return mul(WideInt<2>(a), WideInt<2>(b)); }

/// Returns the low M limbs; the caller knows that the value fits.
template <std::size_t M, std::size_t N>
  requires(M <= N)
[[nodiscard]] constexpr WideInt<M> narrow(const WideInt<N>& a) {
  typename WideInt<M>::Limbs r{};
  for (std::size_t i = 0; i < M; ++i) r[i] = a.limbs()[i];
  return WideInt<M>(r);
}

/// Compares n1/d1 with n2/d2; both denominators are positive.
[[nodiscard]] constexpr std::strong_ordering compare_fractions(Int128 n1, Int128 d1, Int128 n2,
                                                               Int128 d2) {
  return mul(n1, d2) <=> mul(n2, d1);
}

template <std::size_t N, std::size_t M>
[[nodiscard]] constexpr std::strong_ordering compare_fractions(const WideInt<N>& n1,
                                                               const WideInt<M>& d1,
                                                               const WideInt<N>& n2,
                                                               const WideInt<M>& d2) {
  return mul(n1, d2) <=> mul(n2, d1);
}

namespace detail {
/// Limbs are two's complements, lowest first, at most 10 of them.
[[nodiscard]] std::int64_t round_quotient(std::span<const std::uint64_t> n,
                                          std::span<const std::uint64_t> d);
[[nodiscard]] std::int64_t floor_quotient(std::span<const std::uint64_t> n,
                                          std::span<const std::uint64_t> d);
[[nodiscard]] double quotient_to_double(std::span<const std::uint64_t> n,
                                        std::span<const std::uint64_t> d);
[[nodiscard]] double sqrt_quotient_to_double(std::span<const std::uint64_t> n,
                                             std::span<const std::uint64_t> d);
}  // namespace detail

/// Returns n/d rounded to the nearest integer, ties away from zero: a function of the rational
/// alone, so unreduced fractions of one rational round alike. d > 0; the quotient fits 63 bits.
template <std::size_t N, std::size_t M>
[[nodiscard]] std::int64_t round_div(const WideInt<N>& n, const WideInt<M>& d) {
  return detail::round_quotient(n.limbs(), d.limbs());
}
[[nodiscard]] inline std::int64_t round_div(Int128 n, Int128 d) {
  return round_div(WideInt<2>(n), WideInt<2>(d));
}

/// Returns the largest integer not above n/d. d > 0; the quotient fits 63 bits.
template <std::size_t N, std::size_t M>
[[nodiscard]] std::int64_t floor_div(const WideInt<N>& n, const WideInt<M>& d) {
  return detail::floor_quotient(n.limbs(), d.limbs());
}
[[nodiscard]] inline std::int64_t floor_div(Int128 n, Int128 d) {
  return floor_div(WideInt<2>(n), WideInt<2>(d));
}

/// Returns n/d rounded to the nearest double, ties to even (results are normal numbers or zero). d
/// > 0.
template <std::size_t N, std::size_t M>
[[nodiscard]] double ratio_to_double(const WideInt<N>& n, const WideInt<M>& d) {
  return detail::quotient_to_double(n.limbs(), d.limbs());
}
[[nodiscard]] inline double ratio_to_double(Int128 n, Int128 d) {
  return ratio_to_double(WideInt<2>(n), WideInt<2>(d));
}

/// Returns the square root of n/d rounded to the nearest double. n >= 0, d > 0.
template <std::size_t N, std::size_t M>
[[nodiscard]] double sqrt_ratio_to_double(const WideInt<N>& n, const WideInt<M>& d) {
  return detail::sqrt_quotient_to_double(n.limbs(), d.limbs());
}

}  // namespace strake::geometry
