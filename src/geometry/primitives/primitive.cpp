// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/primitive.hpp"

#include <cmath>
#include <cstdint>
#include <string_view>
#include <variant>

#include "geometry/numeric/trig.hpp"
#include "geometry/primitives/domes.hpp"
#include "strake/geometry/ellipse.hpp"

namespace strake::geometry {

namespace {

enum class Surface : std::uint8_t { flat, partly_curved, round };

struct Kind {
  std::string_view name;
  Surface surface = Surface::flat;
};

/// What holds for all primitives of a kind.
struct KindOf {
  Kind operator()(const BoxPrimitive& /*p*/) const { return {"box"}; }
  Kind operator()(const PyramidPrimitive& /*p*/) const { return {"pyramid"}; }
  Kind operator()(const CylinderPrimitive& /*p*/) const { return {"cylinder", Surface::round}; }
  Kind operator()(const SnoutPrimitive& /*p*/) const { return {"snout", Surface::round}; }
  Kind operator()(const SpherePrimitive& /*p*/) const { return {"sphere", Surface::round}; }
  Kind operator()(const EllipticalDishPrimitive& /*p*/) const {
    return {"elliptical_dish", Surface::round};
  }
  Kind operator()(const SphericalDishPrimitive& /*p*/) const {
    return {"spherical_dish", Surface::round};
  }
  Kind operator()(const CircularTorusPrimitive& /*p*/) const {
    return {"circular_torus", Surface::round};
  }
  Kind operator()(const RectangularTorusPrimitive& /*p*/) const {
    return {"rectangular_torus", Surface::partly_curved};
  }
  Kind operator()(const LinePrimitive& /*p*/) const { return {"line"}; }
};

Kind kind_of(const Primitive& primitive) { return std::visit(KindOf{}, primitive); }

}  // namespace

bool is_round(const Primitive& primitive) { return kind_of(primitive).surface == Surface::round; }

bool is_curved(const Primitive& primitive) { return kind_of(primitive).surface != Surface::flat; }

std::string_view kind_name(const Primitive& primitive) { return kind_of(primitive).name; }

namespace {

/// In the primitive's own frame, by kind.
class Circles {
 public:
  explicit Circles(const std::optional<Vec3d>& towards) : towards_(towards) {}

  void operator()(const CylinderPrimitive& p) {
    level(-p.height / 2, p.radius);
    level(p.height / 2, p.radius);
  }
  void operator()(const SnoutPrimitive& p) {
    const Vec3d half{p.offset_x / 2, p.offset_y / 2, p.height / 2};
    if (p.bottom_shear_x == 0 && p.bottom_shear_y == 0) level(-half, p.bottom_radius);
    if (p.top_shear_x == 0 && p.top_shear_y == 0) level(half, p.top_radius);
  }
  void operator()(const SpherePrimitive& p) {
    if (!towards_) return;
    const Vec3d& d = *towards_;
    const Vec3d helper = std::fabs(d.z) > 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1};
    const Vec3d across = cross(helper, d);
    const Vec3d x = across * (1 / std::sqrt(dot(across, across)));
    add({0, 0, 0}, x * (p.diameter / 2), cross(d, x) * (p.diameter / 2));
  }
  void operator()(const EllipticalDishPrimitive& p) {
    level(0, p.radius);
    if (!towards_ || !(p.height > 0)) return;
    const auto phase = tessellation::contour_phase(towards_->x, towards_->y, towards_->z);
    if (!phase) return;
    // As in the mesh: a great circle of the ball that the dish is an image of.
    const Vec3d pole{phase->cos, phase->sin, 0}, across{phase->sin, -phase->cos, 0};
    const double out = dot(*towards_, across) / p.radius, up = towards_->z / p.height;
    const double size = std::sqrt(out * out + up * up);
    add({0, 0, 0}, pole * p.radius,
        across * (-up / size * p.radius) + Vec3d{0, 0, out / size * p.height});
  }
  void operator()(const SphericalDishPrimitive& p) {
    level(0, p.radius);
    if (!towards_ || !(p.height > 0)) return;
    if (const auto c = tessellation::CapContour::of(p, *towards_)) {
      const SinCos tilt = sin_cos(c->tilt);
      add({0, 0, c->centre}, c->across * c->ball,
          (c->out * tilt.sin + Vec3d{0, 0, tilt.cos}) * c->ball);
    }
  }
  void operator()(const CircularTorusPrimitive& p) {
    level(-p.tube_radius, p.centre_radius);
    level(p.tube_radius, p.centre_radius);
    level(0, p.centre_radius + p.tube_radius);
    level(0, p.centre_radius - p.tube_radius);
    if (!is_full_turn(p.angle)) {
      section(p, sin_cos(0));
      section(p, sin_cos(p.angle));
    }
    if (!towards_) return;
    // Seen edge-on in elevation.
    const double size = std::sqrt(towards_->x * towards_->x + towards_->y * towards_->y);
    if (!(size > 0)) return;
    const SinCos on{-towards_->x / size, towards_->y / size};
    section(p, on);
    section(p, {-on.sin, -on.cos});
  }
  template <class Other>
  void operator()(const Other&) {}

  [[nodiscard]] std::vector<Ellipse> take() && { return std::move(all_); }

 private:
  void add(const Vec3d& centre, const Vec3d& u, const Vec3d& v) { all_.push_back({centre, u, v}); }
  void level(const Vec3d& centre, double radius) {
    if (radius > 0) add(centre, {radius, 0, 0}, {0, radius, 0});
  }
  void level(double z, double radius) { level(Vec3d{0, 0, z}, radius); }
  void section(const CircularTorusPrimitive& p, const SinCos& at) {
    const Vec3d out{at.cos, at.sin, 0};
    add(out * p.centre_radius, out * p.tube_radius, {0, 0, p.tube_radius});
  }

  const std::optional<Vec3d>& towards_;
  std::vector<Ellipse> all_;
};

}  // namespace

bool Ellipse::passes(const Vec3d& point, double tolerance) const {
  const Vec3d p = point - centre;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), pu = dot(p, u), pv = dot(p, v);
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) return false;
  const double a = (pu * vv - pv * uv) / determinant, b = (pv * uu - pu * uv) / determinant;
  const Vec3d off = p - u * a - v * b;
  const double size = std::sqrt(a * a + b * b);
  if (!(size > 0)) return false;
  const Vec3d in_plane = (u * a + v * b) * (1 - 1 / size);
  return dot(off, off) + dot(in_plane, in_plane) <= tolerance * tolerance;
}

std::vector<Ellipse> circles_of(const Primitive& primitive, const Mat3d& linear,
                                const Vec3d& towards) {
  const auto local = tessellation::local_direction(linear, towards);
  Circles circles(local);
  std::visit(circles, primitive);
  std::vector<Ellipse> placed = std::move(circles).take();
  for (Ellipse& e : placed) e = {linear * e.centre, linear * e.u, linear * e.v};
  return placed;
}

}  // namespace strake::geometry
