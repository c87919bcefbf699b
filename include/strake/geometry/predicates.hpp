// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {

/// Exact orientation predicates, with a floating-point filter, on grid coordinates whose
/// differences are at most 2^31 units.
///
/// Each evaluates a 3x3 determinant twice: in double, which is the filter, and in 64-bit arithmetic
/// that wraps. The double is off by less than 32·2^-53·2^93 = 2^45, so where it is below 2^62 the
/// true value fits 63 bits and the wrapped value *is* the true value; elsewhere the sign of the
/// double is certain. So a sign never needs wide arithmetic.

/// A determinant as a number whose sign is exact; the magnitude is exact below 2^53, else rounded.
class SignedDet {
 public:
  constexpr explicit SignedDet(double approximate, std::uint64_t wrapped)
      : value_(approximate < kWrapLimit && approximate > -kWrapLimit
                   ? static_cast<double>(static_cast<std::int64_t>(wrapped))
                   : approximate) {}
  [[nodiscard]] constexpr int sign() const { return (value_ > 0) - (value_ < 0); }
  [[nodiscard]] constexpr double value() const { return value_; }

 private:
  static constexpr double kWrapLimit = 4611686018427387904.0;  // 2^62
  double value_;
};

/// The plane through three points, prepared for many side tests. The normal (b-a) x (c-a) points to
/// its positive side: outside, for a triangle of a solid.
class ExactPlane {
 public:
  constexpr ExactPlane(const Vec3l& a, const Vec3l& b, const Vec3l& c) : a_(a) {
    const Vec3l u = b - a, v = c - a;
    approximate_ = cross(u.as<double>(), v.as<double>());
    wrapped_ = cross(u.as<std::uint64_t>(), v.as<std::uint64_t>());
  }
  [[nodiscard]] constexpr SignedDet det(const Vec3l& p) const {
    const Vec3l d = p - a_;
    return SignedDet(dot(approximate_, d.as<double>()), dot(wrapped_, d.as<std::uint64_t>()));
  }
  [[nodiscard]] constexpr int side(const Vec3l& p) const {
    constexpr double kCertain = 70368744177664.0;  // 2^46: twice the largest error
    const Vec3l d = p - a_;
    const double approximate = dot(approximate_, d.as<double>());
    if (approximate > kCertain) return 1;
    if (approximate < -kCertain) return -1;
    const auto exact = static_cast<std::int64_t>(dot(wrapped_, d.as<std::uint64_t>()));
    return (exact > 0) - (exact < 0);
  }
  /// Returns the rounded normal; components are off by at most 2^-51 of the largest edge product.
  [[nodiscard]] constexpr const Vec3d& normal() const { return approximate_; }

 private:
  Vec3l a_;
  Vec3d approximate_;
  Vec3<std::uint64_t> wrapped_;
};

/// Returns the sign of det(b-a, c-a, p-a): +1 when p lies on the side of the normal (b-a) x (c-a).
[[nodiscard]] constexpr int orient3d(const Vec3l& a, const Vec3l& b, const Vec3l& c,
                                     const Vec3l& p) {
  return ExactPlane(a, b, c).side(p);
}

/// Returns the exact cross product (65 bits per component for differences of 2^31).
[[nodiscard]] constexpr Vec3<Int128> cross_exact(const Vec3l& u, const Vec3l& v) {
  return cross(u.as<Int128>(), v.as<Int128>());
}

/// Returns the exact determinant det(u, v, w), for callers that need its value: at most 98 bits for
/// components of 2^31.
[[nodiscard]] constexpr Int128 det_exact(const Vec3l& u, const Vec3l& v, const Vec3l& w) {
  return dot(cross_exact(u, v), w.as<Int128>());
}

/// Returns the two coordinates that remain when `axis` is dropped, so that (first, second, axis) is
/// right-handed.
[[nodiscard]] constexpr Vec3l drop_axis(const Vec3l& p, int axis) {
  return axis == 0 ? Vec3l{p.y, p.z, 0} : axis == 1 ? Vec3l{p.z, p.x, 0} : Vec3l{p.x, p.y, 0};
}

/// Returns the sign of the 2D orientation of p, q, r seen along `axis` (0, 1, 2) from its positive
/// end.
[[nodiscard]] constexpr int orient2d(const Vec3l& p, const Vec3l& q, const Vec3l& r, int axis) {
  const Vec3l u = drop_axis(q - p, axis), v = drop_axis(r - p, axis);
  const Int128 d = static_cast<Int128>(u.x) * v.y - static_cast<Int128>(u.y) * v.x;
  return (d > 0) - (d < 0);
}

}  // namespace strake::geometry
