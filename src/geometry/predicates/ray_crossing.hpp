// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/inside.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// Counts how often a surface winds round a point, by the triangles that a ray along an axis meets;
/// pass each triangle of the surface once, except those that the ray misses.
class RayCrossings {
 public:
  RayCrossings() = default;
  RayCrossings(const ScaledPoint& point, int axis, bool upward)
      : point_(point), axis_(axis), upward_(upward) {}

  /// Counts a triangle; false when the point lies on it: then nothing else matters.
  [[nodiscard]] bool pass(const TriangleCorners& t);

  /// Whether the ray may meet a box; false is certain.
  template <class T>
  [[nodiscard]] bool may_meet(const Vec3<T>& lo, const Vec3<T>& hi) const {
    for (int k = 0; k < 3; ++k) {
      const bool below = point_.numerator[k] < lo[k] * point_.denominator;
      const bool above = point_.numerator[k] > hi[k] * point_.denominator;
      if (k != axis_ ? (below || above) : (upward_ ? above : below)) return false;
    }
    return true;
  }

  [[nodiscard]] int number() const { return number_; }

 private:
  ScaledPoint point_;
  int axis_ = 0;
  bool upward_ = true;
  int number_ = 0;
};

}  // namespace strake::geometry
