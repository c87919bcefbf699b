// SPDX-License-Identifier: Apache-2.0
#include "model/ends/primitive_ends.hpp"

#include <array>
#include <variant>

#include "geometry/numeric/trig.hpp"

namespace strake::model {
namespace {

using geometry::Vec3d;
using Ends = std::vector<PrimitiveEnd>;

/// Returns the ends of a sweep about Z in the XY plane, from +X on.
Ends ends_of_sweep(double radius, double angle) {
  if (!(angle > 0) || angle >= 2 * geometry::kPi || !(radius > 0)) return {};
  const geometry::SinCos at = geometry::sin_cos(angle);
  return {{{radius, 0, 0}, {0, -1, 0}},
          {{radius * at.cos, radius * at.sin, 0}, {-at.sin, at.cos, 0}}};
}

struct EndsOf {
  Ends operator()(const geometry::BoxPrimitive& box) const {
    const std::array<double, 3> lengths{box.length_x, box.length_y, box.length_z};
    for (int k = 0; k < 3; ++k) {
      const auto length = [&](int i) { return lengths[static_cast<std::size_t>(i % 3)]; };
      if (!(length(k) > length(k + 1) && length(k) > length(k + 2))) continue;
      Vec3d along;
      along[k] = 1;
      return {{along * (length(k) / -2), -along}, {along * (length(k) / 2), along}};
    }
    return {};
  }

  Ends operator()(const geometry::PyramidPrimitive& pyramid) const {
    const Vec3d top{pyramid.offset_x / 2, pyramid.offset_y / 2, pyramid.height / 2};
    Ends ends;
    if (pyramid.bottom_x > 0 && pyramid.bottom_y > 0) ends.push_back({-top, {0, 0, -1}});
    if (pyramid.top_x > 0 && pyramid.top_y > 0) ends.push_back({top, {0, 0, 1}});
    return ends;
  }

  Ends operator()(const geometry::CylinderPrimitive& cylinder) const {
    if (!(cylinder.radius > 0)) return {};
    return {{{0, 0, cylinder.height / -2}, {0, 0, -1}}, {{0, 0, cylinder.height / 2}, {0, 0, 1}}};
  }

  Ends operator()(const geometry::SnoutPrimitive& snout) const {
    const Vec3d top{snout.offset_x / 2, snout.offset_y / 2, snout.height / 2};
    const auto slope = [](double shear) {
      const geometry::SinCos at = geometry::sin_cos(shear);
      return at.sin / at.cos;
    };
    Ends ends;
    if (snout.bottom_radius > 0)
      ends.push_back({-top, {slope(snout.bottom_shear_x), slope(snout.bottom_shear_y), -1}});
    if (snout.top_radius > 0)
      ends.push_back({top, {-slope(snout.top_shear_x), -slope(snout.top_shear_y), 1}});
    return ends;
  }

  Ends operator()(const geometry::EllipticalDishPrimitive& dish) const { return base(dish.radius); }
  Ends operator()(const geometry::SphericalDishPrimitive& dish) const { return base(dish.radius); }

  Ends operator()(const geometry::CircularTorusPrimitive& torus) const {
    return ends_of_sweep(torus.centre_radius, torus.angle);
  }
  Ends operator()(const geometry::RectangularTorusPrimitive& torus) const {
    return ends_of_sweep((torus.inner_radius + torus.outer_radius) / 2, torus.angle);
  }

  Ends operator()(const geometry::SpherePrimitive&) const { return {}; }
  Ends operator()(const geometry::LinePrimitive&) const { return {}; }

 private:
  static Ends base(double radius) { return radius > 0 ? Ends{{{}, {0, 0, -1}}} : Ends{}; }
};

}  // namespace

std::vector<PrimitiveEnd> ends_of(const geometry::Primitive& primitive) {
  return std::visit(EndsOf{}, primitive);
}

}  // namespace strake::model
