// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "geometry/numeric/triangle_math.hpp"
#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/intersect.hpp"
#include "strake/geometry/rational.hpp"
#include "strake/geometry/wide_int.hpp"

// Features of triangles, and clipping of a line by half-spaces, in exact arithmetic.

namespace strake::geometry {

[[nodiscard]] inline int sign_of(Int128 v) { return (v > 0) - (v < 0); }

/// Returns an axis along which a vector does not vanish, or -1.
[[nodiscard]] inline int any_axis(const Vec3<Int128>& v) {
  return v.x != 0 ? 0 : v.y != 0 ? 1 : v.z != 0 ? 2 : -1;
}

/// Returns the feature of a triangle that a point of it lies on: bit i of `on_edges` is set when it
/// is on edge i.
[[nodiscard]] inline FeatureMask place_of(unsigned on_edges) {
  FeatureMask place = 7;
  for (unsigned i = 0; i < 3; ++i)
    if ((on_edges >> i & 1U) != 0)
      place &= static_cast<FeatureMask>((1U << i) | (1U << next_corner(i)));
  return place;
}

/// A function that is linear along a line, given by its values at the parameters 0 and 1.
struct AffineFunction {
  Int128 at_0 = 0, at_1 = 0;

  /// Returns its sign at a finite parameter.
  [[nodiscard]] int sign_at(const Rational& t) const {
    return (mul(at_0, t.den - t.num) + mul(at_1, t.num)).sign();
  }
};

/// Clips a line by half-spaces to an interval of parameters.
class HalfSpaceClip {
 public:
  explicit HalfSpaceClip(const GridLine& line) {
    const bool point = line.from == line.to;
    if (line.reach == LineKind::line && !point) first_ = {-1, 0};
    if (line.reach != LineKind::segment && !point) last_ = {1, 0};
    if (line.reach == LineKind::segment && !point) last_ = {1, 1};
  }

  /// Keeps the parameters where the function is not negative.
  void keep(const AffineFunction& f) {
    const Int128 slope = f.at_1 - f.at_0;
    if (slope == 0) {
      empty_ = empty_ || f.at_0 < 0;
      return;
    }
    const Rational zero = slope > 0 ? Rational{-f.at_0, slope} : Rational{f.at_0, -slope};
    if (slope > 0 && first_ < zero) first_ = zero;
    if (slope < 0 && zero < last_) last_ = zero;
  }

  [[nodiscard]] LineStretch result() const {
    if (empty_ || last_ < first_) return {};
    return {first_ == last_ ? Touch::point : Touch::segment, first_, last_};
  }

 private:
  Rational first_, last_;
  bool empty_ = false;
};

}  // namespace strake::geometry
