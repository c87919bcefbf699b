// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace strake::geometry {

/// Three coordinates. Doubles are millimetres; integers are grid units (micrometres, see grid.hpp).
template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  constexpr T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr const T& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {static_cast<T>(a.x + b.x), static_cast<T>(a.y + b.y), static_cast<T>(a.z + b.z)};
  }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {static_cast<T>(a.x - b.x), static_cast<T>(a.y - b.y), static_cast<T>(a.z - b.z)};
  }
  friend constexpr Vec3 operator-(const Vec3& a) {
    return {static_cast<T>(-a.x), static_cast<T>(-a.y), static_cast<T>(-a.z)};
  }
  friend constexpr Vec3 operator*(const Vec3& a, T s) {
    return {static_cast<T>(a.x * s), static_cast<T>(a.y * s), static_cast<T>(a.z * s)};
  }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
  friend constexpr auto operator<=>(const Vec3&, const Vec3&) = default;

  template <class U>
  [[nodiscard]] constexpr Vec3<U> as() const {
    return {static_cast<U>(x), static_cast<U>(y), static_cast<U>(z)};
  }
};

using Vec3d = Vec3<double>;
using Vec3i = Vec3<std::int32_t>;
using Vec3l = Vec3<std::int64_t>;

template <class T>
[[nodiscard]] constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
[[nodiscard]] constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A 3x3 matrix by rows: (row[0]·v, row[1]·v, row[2]·v).
struct Mat3d {
  std::array<Vec3d, 3> row{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};

  friend constexpr Vec3d operator*(const Mat3d& m, const Vec3d& v) {
    return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
  }
  friend constexpr Mat3d operator*(const Mat3d& a, const Mat3d& b) {
    Mat3d r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        r.row[static_cast<std::size_t>(i)][j] = a.row[static_cast<std::size_t>(i)].x * b.row[0][j] +
                                                a.row[static_cast<std::size_t>(i)].y * b.row[1][j] +
                                                a.row[static_cast<std::size_t>(i)].z * b.row[2][j];
    return r;
  }
  friend constexpr bool operator==(const Mat3d&, const Mat3d&) = default;
  [[nodiscard]] constexpr double determinant() const { return dot(row[0], cross(row[1], row[2])); }
};

/// An affine placement: world = linear · local + translation (millimetres).
struct Placement {
  Mat3d linear;
  Vec3d translation;

  friend constexpr Vec3d operator*(const Placement& p, const Vec3d& v) {
    return p.linear * v + p.translation;
  }
  friend constexpr Placement operator*(const Placement& a, const Placement& b) {
    return {a.linear * b.linear, a * b.translation};
  }
};

/// Whether all numbers are finite: the three of a vector, the twelve of a placement.
[[nodiscard]] inline bool is_finite(const Vec3d& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
[[nodiscard]] inline bool is_finite(const Placement& p) {
  return is_finite(p.linear.row[0]) && is_finite(p.linear.row[1]) && is_finite(p.linear.row[2]) &&
         is_finite(p.translation);
}

/// A closed axis-aligned box; empty when lo > hi on any axis.
template <class T>
struct Box3 {
  Vec3<T> lo, hi;

  [[nodiscard]] constexpr bool empty() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }
  constexpr void include(const Vec3<T>& p) {
    for (int k = 0; k < 3; ++k) {
      if (p[k] < lo[k]) lo[k] = p[k];
      if (p[k] > hi[k]) hi[k] = p[k];
    }
  }
  constexpr void include(const Box3& b) {
    if (b.empty()) return;
    include(b.lo);
    include(b.hi);
  }
  /// Whether the closed boxes share at least a point.
  [[nodiscard]] constexpr bool meets(const Box3& b) const {
    return lo.x <= b.hi.x && b.lo.x <= hi.x && lo.y <= b.hi.y && b.lo.y <= hi.y && lo.z <= b.hi.z &&
           b.lo.z <= hi.z;
  }
  /// Whether all of a box that is not empty lies in this closed one.
  [[nodiscard]] constexpr bool contains(const Box3& b) const {
    return lo.x <= b.lo.x && b.hi.x <= hi.x && lo.y <= b.lo.y && b.hi.y <= hi.y && lo.z <= b.lo.z &&
           b.hi.z <= hi.z;
  }
  [[nodiscard]] constexpr Box3 moved(const Vec3<T>& by) const { return {lo + by, hi + by}; }
  /// Returns the box grown by `by` on every side.
  [[nodiscard]] constexpr Box3 inflated(T by) const {
    return {lo - Vec3<T>{by, by, by}, hi + Vec3<T>{by, by, by}};
  }
  /// Returns the intersection of two boxes; empty where they do not meet.
  [[nodiscard]] constexpr Box3 common(const Box3& b) const {
    Box3 both = *this;
    for (int k = 0; k < 3; ++k) {
      if (both.lo[k] < b.lo[k]) both.lo[k] = b.lo[k];
      if (b.hi[k] < both.hi[k]) both.hi[k] = b.hi[k];
    }
    return both;
  }
  template <class U>
  [[nodiscard]] constexpr Box3<U> as() const {
    return {lo.template as<U>(), hi.template as<U>()};
  }
  friend constexpr bool operator==(const Box3&, const Box3&) = default;
};

using Box3d = Box3<double>;
using Box3i = Box3<std::int32_t>;
using Box3l = Box3<std::int64_t>;

/// Returns a box that is empty; including a point makes it that point.
template <class T>
[[nodiscard]] constexpr Box3<T> empty_box() {
  if constexpr (std::is_floating_point_v<T>) {
    constexpr T kBig = static_cast<T>(1e300);
    return {{kBig, kBig, kBig}, {-kBig, -kBig, -kBig}};
  } else {
    constexpr T kLow = static_cast<T>(T{1} << (sizeof(T) * 8 - 2));
    return {{kLow, kLow, kLow},
            {static_cast<T>(-kLow), static_cast<T>(-kLow), static_cast<T>(-kLow)}};
  }
}

}  // namespace strake::geometry
