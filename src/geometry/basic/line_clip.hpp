// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/intersect.hpp"
#include "strake/geometry/rational.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {

/// A function that is linear along a line, by its values at the parameters 0 and 1.
struct LinearAlong {
  Int128 at_0 = 0, at_1 = 0;

  /// Its sign at a finite parameter.
  [[nodiscard]] int sign_at(const Rational& t) const {
    return (mul(at_0, t.den - t.num) + mul(at_1, t.num)).sign();
  }
};

/// The stretch of a line that half-spaces leave of it.
class LineClip {
 public:
  explicit LineClip(const GridLine& line) {
    const bool point = line.from == line.to;
    if (line.reach == Reach::line && !point) first_ = {-1, 0};
    if (line.reach != Reach::segment && !point) last_ = {1, 0};
    if (line.reach == Reach::segment && !point) last_ = {1, 1};
  }

  /// Keeps where the function is not negative.
  void keep(const LinearAlong& f) {
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
