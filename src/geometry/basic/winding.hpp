// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/inside.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// Counts how often a surface winds round a point, by the triangles that a ray along an axis
/// meets; each triangle of the surface is to be shown once, but for those that the ray misses.
class Winding {
 public:
  Winding() = default;
  Winding(const ScaledPoint& point, int axis, bool upward)
      : point_(point), axis_(axis), upward_(upward) {}

  /// False when the point lies on the triangle: then nothing else matters.
  [[nodiscard]] bool pass(const TriangleCorners& t);

  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] const ScaledPoint& point() const { return point_; }
  [[nodiscard]] int axis() const { return axis_; }
  [[nodiscard]] bool upward() const { return upward_; }

 private:
  ScaledPoint point_;
  int axis_ = 0;
  bool upward_ = true;
  int number_ = 0;
};

}  // namespace strake::geometry
