// SPDX-License-Identifier: Apache-2.0
// Seeded primitives of extreme proportions: lengths from a few grid units to metres in one body.
#pragma once

#include <cmath>
#include <cstdint>

#include "strake/geometry/primitive.hpp"
#include "support/random_primitives.hpp"

namespace strake::test {

/// Lengths even in their logarithm between `least` and `most`, each drawn on its own.
class SlenderDraw {
 public:
  static constexpr std::uint64_t kKinds = PrimitiveDraw::kConvexKinds + 2;

  SlenderDraw(PrimitiveDraw& draw, double least, double most)
      : draw_(draw), low_(std::log(least)), high_(std::log(most)) {}

  geometry::Primitive of_kind(std::uint64_t kind) {
    switch (kind) {
      case 0: {
        const double x = length(), y = length();
        return geometry::BoxPrimitive{x, y, length()};
      }
      case 1:
        return pyramid();
      case 2: {
        const double r = length();
        return geometry::CylinderPrimitive{r, length()};
      }
      case 3:
        return snout();
      case 4:
        return geometry::SpherePrimitive{length()};
      case 5: {
        const double r = length();
        return geometry::EllipticalDishPrimitive{r, length()};
      }
      case 6: {
        const double r = length();
        return geometry::SphericalDishPrimitive{r, length()};
      }
      case 7: {
        geometry::CircularTorusPrimitive t;
        t.tube_radius = length();
        t.centre_radius = t.tube_radius + (draw_.one_in(5) ? 0 : length());
        t.angle = angle();
        return t;
      }
      default: {
        geometry::RectangularTorusPrimitive t;
        t.inner_radius = draw_.one_in(4) ? 0 : length();
        t.outer_radius = t.inner_radius + length();
        t.height = length();
        t.angle = angle();
        return t;
      }
    }
  }

 private:
  double length() { return std::exp(draw_.between(low_, high_)); }
  double angle() {
    constexpr double kTurn = 6.283185307179586;
    if (draw_.one_in(4)) return kTurn;
    return draw_.one_in(3) ? kTurn / 2 : draw_.one_in(3) ? kTurn / 4 : draw_.between(0.05, 6.2);
  }
  /// Of one body in two, the top leans away from the bottom.
  double offset() { return draw_.one_in(2) ? 0 : draw_.one_in(2) ? length() : -length(); }

  geometry::Primitive pyramid() {
    geometry::PyramidPrimitive p;
    p.bottom_x = length();
    p.bottom_y = length();
    p.top_x = draw_.one_in(4) ? 0 : length();
    p.top_y = draw_.one_in(4) ? 0 : length();
    p.offset_x = offset();
    p.offset_y = offset();
    p.height = length();
    return p;
  }
  geometry::Primitive snout() {
    geometry::SnoutPrimitive p;
    p.bottom_radius = length();
    p.top_radius = draw_.one_in(6) ? 0 : length();
    p.height = length();
    p.offset_x = offset();
    p.offset_y = offset();
    if (draw_.one_in(3)) {
      p.bottom_shear_x = draw_.between(-0.3, 0.3);
      p.top_shear_y = draw_.between(-0.3, 0.3);
    }
    return p;
  }

  PrimitiveDraw& draw_;
  double low_ = 0, high_ = 0;
};

}  // namespace strake::test
