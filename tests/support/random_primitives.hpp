// SPDX-License-Identifier: Apache-2.0
// Seeded primitives of every kind under placements of every sort.
#pragma once

#include <cmath>
#include <cstdint>

#include "draw.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::test {

class PrimitiveDraw : public Draw {
 public:
  using Draw::Draw;

  geometry::Vec3d point(double reach) {
    const double x = between(-reach, reach), y = between(-reach, reach);
    return {x, y, between(-reach, reach)};
  }
  geometry::Vec3d direction() {
    for (;;) {
      const geometry::Vec3d v = point(1);
      const double square = geometry::dot(v, v);
      if (square > 0.01 && square <= 1) return v * (1 / std::sqrt(square));
    }
  }

  /// A rotation from a random quaternion; of one in eight, one of the axes' own.
  geometry::Mat3d turn() {
    if (one_in(8)) return {};
    return rotation();
  }
  /// Mostly a rotation; else mirrored, of single precision, stretched or sheared.
  geometry::Mat3d linear(bool similarity = false) {
    geometry::Mat3d m = turn();
    if (one_in(6)) m.row[0] = -m.row[0];
    if (one_in(6))
      for (geometry::Vec3d& row : m.row)
        for (int k = 0; k < 3; ++k) row[k] = static_cast<double>(static_cast<float>(row[k]));
    if (similarity) return m;
    if (one_in(8)) {
      const double f = between(0.3, 2);
      for (geometry::Vec3d& row : m.row) row.x *= f;
    }
    if (one_in(8)) m.row[0].z += between(-0.5, 0.5);
    return m;
  }

  /// A convex kind, about `size` mm large.
  static constexpr std::uint64_t kConvexKinds = 7;
  geometry::Primitive convex(std::uint64_t kind, double size) {
    const auto length = [&] { return between(0.05, 1) * size; };
    switch (kind) {
      case 0: {
        const double x = length(), y = length();
        return geometry::BoxPrimitive{x, y, length()};
      }
      case 1:
        return pyramid(size);
      case 2: {
        const double r = length() / 2;
        return geometry::CylinderPrimitive{r, 3 * length()};
      }
      case 3:
        return snout(size);
      case 4:
        return geometry::SpherePrimitive{length()};
      case 5: {
        const double r = length() / 2;
        return geometry::EllipticalDishPrimitive{r, length() / 3};
      }
      default: {
        const double r = length() / 2;
        return geometry::SphericalDishPrimitive{r, length() / 2};
      }
    }
  }
  /// Elbows, rings and bends, about `size` mm large.
  geometry::Primitive torus(double size) {
    const double angle = one_in(5) ? 6.283185307179586 : between(0.1, 6.2);
    if (one_in(2)) {
      geometry::CircularTorusPrimitive t;
      t.tube_radius = between(0.05, 0.4) * size;
      t.centre_radius = t.tube_radius * (one_in(6) ? 1 : between(1, 6));
      t.angle = angle;
      return t;
    }
    geometry::RectangularTorusPrimitive t;
    t.outer_radius = between(0.2, 1) * size;
    t.inner_radius = one_in(5) ? 0 : t.outer_radius * between(0.1, 0.95);
    t.height = between(0.05, 1) * size;
    t.angle = angle;
    return t;
  }
  geometry::Primitive convex(double size) { return convex(below(kConvexKinds), size); }

 private:
  geometry::Primitive pyramid(double size) {
    geometry::PyramidPrimitive p;
    p.bottom_x = between(0.05, 1) * size;
    p.bottom_y = between(0.05, 1) * size;
    p.top_x = one_in(4) ? 0 : between(0.05, 1) * size;
    p.top_y = one_in(4) ? 0 : between(0.05, 1) * size;
    p.offset_x = between(-0.5, 0.5) * size;
    p.offset_y = between(-0.5, 0.5) * size;
    p.height = between(0.05, 1) * size;
    return p;
  }
  geometry::Primitive snout(double size) {
    geometry::SnoutPrimitive p;
    p.bottom_radius = between(0.05, 0.5) * size;
    p.top_radius = one_in(4) ? 0 : between(0.05, 0.5) * size;
    p.height = between(0.3, 1) * size;
    p.offset_x = between(-0.3, 0.3) * size;
    p.offset_y = between(-0.3, 0.3) * size;
    if (one_in(2)) {
      p.bottom_shear_x = between(-0.2, 0.2);
      p.bottom_shear_y = between(-0.2, 0.2);
      p.top_shear_x = between(-0.2, 0.2);
      p.top_shear_y = between(-0.2, 0.2);
    }
    return p;
  }
};

}  // namespace strake::test
