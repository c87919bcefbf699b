// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitive_pairs/shapes/torus.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "geometry/numeric/trig.hpp"
#include "geometry/primitive_pairs/shapes/rigid_primitive.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::geometry::primitive_pairs {
namespace {

Profile scaled(const Profile& p, double by) {
  return {p.round, p.centre * by, p.radius * by, 0, p.inner * by, p.outer * by, p.half_height * by};
}

double reach_of(const Profile& p) {
  return p.round ? p.centre + p.radius : p.outer + p.half_height;
}

}  // namespace

/// The section and how far it is swept.
struct Torus::Shape {
  Profile profile;
  double angle = 0;
  bool flat = false;

  [[nodiscard]] static std::optional<Shape> read(const Primitive& primitive) {
    Shape s;
    if (const auto* t = std::get_if<CircularTorusPrimitive>(&primitive)) {
      if (!(t->tube_radius > 0) || !(t->centre_radius >= t->tube_radius)) return std::nullopt;
      s.profile.round = true;
      s.profile.centre = t->centre_radius;
      s.profile.radius = t->tube_radius;
      s.angle = t->angle;
    } else if (const auto* r = std::get_if<RectangularTorusPrimitive>(&primitive)) {
      if (!(r->inner_radius >= 0) || !(r->outer_radius >= r->inner_radius) || !(r->height >= 0) ||
          !(r->outer_radius > 0))
        return std::nullopt;
      s.profile.inner = r->inner_radius;
      s.profile.outer = r->outer_radius;
      s.profile.half_height = r->height / 2;
      s.flat = !(r->height > 0) || !(r->outer_radius > r->inner_radius);
      s.angle = r->angle;
    } else {
      return std::nullopt;
    }
    if (!(s.angle > 0) || !std::isfinite(s.angle)) return std::nullopt;
    return s;
  }
};

/// A point as seen in the half-plane of the sweep that is nearest to it.
struct Torus::Meridian {
  SinCos at;
  double out = 0, up = 0, beside = 0;  ///< along the half-plane, along the axis, across it
};

/// The end of the sweep that is nearest to a point within it, and the way out there, unit.
struct Torus::End {
  double depth = std::numeric_limits<double>::infinity();
  Vec3d way;
};

std::optional<Torus> Torus::of(const PlacedPrimitive& p, const Vec3l& origin) {
  const auto shape = Shape::read(*p.primitive);
  return shape ? place(*shape, *p.placement, origin) : std::nullopt;
}

std::optional<Torus> Torus::of(const CircularArc& arc, const Vec3l& origin) {
  const bool sound = arc.radius_mm > 0 && std::isfinite(arc.radius_mm) && arc.angle > 0 &&
                     std::isfinite(arc.angle);
  if (!sound) return std::nullopt;
  Shape shape;
  shape.profile.round = true;
  shape.profile.centre = arc.radius_mm;
  shape.angle = arc.angle;
  shape.flat = true;
  return place(shape, arc.placement, origin);
}

std::optional<Torus> Torus::place(const Shape& shape, const Placement& placement,
                                  const Vec3l& origin) {
  const auto frame = grid_frame(placement, origin);
  if (!frame) return std::nullopt;
  const double size = reach_of(shape.profile);
  const auto square = orthonormalised(placement.linear, size);
  if (!square) return std::nullopt;
  Torus t;
  t.frame_ = *frame;
  t.axes_ = square->axes;
  t.centre_ = frame->centre;
  t.profile_ = scaled(shape.profile, square->scale * kGridPerMm);
  t.local_profile_ = shape.profile;
  t.full_ = is_full_turn(shape.angle);
  t.angle_ = t.full_ ? 2 * kPi : shape.angle;
  t.end_ = sin_cos(t.angle_);
  t.flat_ = shape.flat;
  t.radius_ = reach_of(t.profile_);
  t.reach_ = 4 * (frame->reach + 2 * t.radius_);
  t.error_ = square->moved * kGridPerMm + kSupportRounding * t.reach_;
  if (!std::isfinite(t.reach_)) return std::nullopt;
  return t;
}

std::vector<SweptArc> Torus::arcs() const {
  const int count = std::max(1, static_cast<int>(std::ceil(angle_ / (kPi / 2) - 1e-9)));
  std::vector<SweptArc> arcs;
  for (int k = 0; k < count; ++k)
    arcs.push_back(SweptArc::between(angle_ * k / count, angle_ * (k + 1) / count));
  return arcs;
}

ConvexBody Torus::hull(const SweptArc& arc) const {
  ConvexBody body;
  body.shape =
      ArcSweep{frame_.centre, frame_.x, frame_.y, frame_.z, arc.first, arc.last, local_profile_};
  const SinCos mid = sin_cos(arc.middle());
  const double out = profile_.round ? profile_.centre : (profile_.inner + profile_.outer) / 2;
  body.middle = centre_ + turned({out * mid.cos, out * mid.sin, 0});
  body.radius = 2 * radius_;
  body.reach = reach_;
  body.error = kSupportRounding * reach_;
  body.flat = flat_;
  return body;
}

ConvexBody Torus::spine(const SweptArc& arc) const {
  ConvexBody body = hull(arc);
  Profile line = local_profile_;
  line.radius = 0;
  body.shape = ArcSweep{frame_.centre, frame_.x, frame_.y, frame_.z, arc.first, arc.last, line};
  return body;
}

ConvexBody Torus::axis() const {
  ConvexBody body;
  const Vec3d half = axes_[2] * radius_;
  body.shape = Prismoid{{centre_ - half, {}, {}}, {centre_ + half, {}, {}}};
  body.middle = centre_;
  body.radius = radius_;
  body.reach = reach_;
  body.error = kSupportRounding * reach_;
  body.flat = true;
  return body;
}

ConvexBody Torus::notch(double shift) const {
  const SinCos mid = sin_cos(angle_ / 2 + kPi);
  const Vec3d out = turned({mid.cos, mid.sin, 0}), centre = centre_ + out * shift;
  Profile all;
  all.outer = all.half_height = radius_;
  ConvexBody body;
  body.shape = ArcSweep{centre, axes_[0], axes_[1], axes_[2], end_, {0, 1}, all};
  body.middle = centre + out * (radius_ / 2);
  body.radius = 2 * radius_;
  body.reach = reach_ + shift;
  body.error = kSupportRounding * body.reach;
  return body;
}

Vec3d Torus::local(const Vec3d& p) const {
  const Vec3d v = p - centre_;
  return {dot(v, axes_[0]), dot(v, axes_[1]), dot(v, axes_[2])};
}

Torus::Meridian Torus::meridian(const Vec3d& v) const {
  const double out = std::sqrt(v.x * v.x + v.y * v.y);
  const SinCos own = out > 0 ? SinCos{v.y / out, v.x / out} : SinCos{};
  const double from_end = own.cos * end_.sin - own.sin * end_.cos;  // sine of what is left to it
  const bool within =
      full_ || (angle_ <= kPi ? own.sin >= 0 && from_end >= 0 : own.sin >= 0 || from_end >= 0);
  if (within) return {own, out, v.z, 0};
  const Meridian first{{0, 1}, v.x, v.z, v.y};
  const Meridian last{end_, v.x * end_.cos + v.y * end_.sin, v.z, v.y * end_.cos - v.x * end_.sin};
  return first.out >= last.out ? first : last;
}

double Torus::profile_depth(double out, double up) const {
  if (profile_.round) {
    const double a = out - profile_.centre;
    return profile_.radius - std::sqrt(a * a + up * up);
  }
  const double over = std::fabs(up) - profile_.half_height, far = out - profile_.outer;
  // A full turn about the axis itself has no inner wall; the ends see to the others.
  const double near =
      profile_.inner > 0 ? profile_.inner - out : -std::numeric_limits<double>::infinity();
  const double side = std::max(far, near);
  if (over <= 0 && side <= 0) return -std::max(over, side);
  const double x = std::max(side, 0.0), z = std::max(over, 0.0);
  return -std::sqrt(x * x + z * z);
}

/// Nearer than a right angle an end's plane counts, beyond it the axis, where both ends meet.
Torus::End Torus::nearest_end(const Vec3d& v) const {
  if (full_) return {};
  const double out = std::sqrt(v.x * v.x + v.y * v.y);
  const SinCos mid = sin_cos(angle_ / 2);
  End nearest{out, out > 0 ? Vec3d{-v.x / out, -v.y / out, 0} : Vec3d{-mid.cos, -mid.sin, 0}};
  const auto offer = [&](double ahead, double depth, const Vec3d& way) {
    if (ahead > 0 && depth >= 0 && depth < nearest.depth) nearest = {depth, way};
  };
  offer(v.x, v.y, {0, -1, 0});
  offer(v.x * end_.cos + v.y * end_.sin, v.x * end_.sin - v.y * end_.cos, {-end_.sin, end_.cos, 0});
  return nearest;
}

double Torus::depth(const Vec3d& p) const {
  const Vec3d v = local(p);
  const Meridian m = meridian(v);
  const double in = profile_depth(m.out, m.up);
  if (m.beside == 0) return in > 0 ? std::min(in, nearest_end(v).depth) : in;
  const double off = in < 0 ? -in : 0;
  return -std::sqrt(off * off + m.beside * m.beside);
}

Vec3d Torus::nearest(const Vec3d& p) const {
  const Vec3d v = local(p);
  const Meridian m = meridian(v);
  double out = m.out, up = m.up;
  if (profile_.round) {
    const double a = out - profile_.centre, length = std::sqrt(a * a + up * up);
    const double f = length > profile_.radius ? profile_.radius / length : 1;
    out = profile_.centre + a * f;
    up = up * f;
  } else {
    out = std::clamp(out, profile_.inner, profile_.outer);
    up = std::clamp(up, -profile_.half_height, profile_.half_height);
  }
  return centre_ + turned({out * m.at.cos, out * m.at.sin, up});
}

Vec3d Torus::exit_direction(const Vec3d& p) const {
  const Vec3d v = local(p);
  const Meridian m = meridian(v);
  const double in = profile_depth(m.out, m.up);
  if (const End end = nearest_end(v); end.depth < in) return turned(end.way);
  double out = 0, up = 0;
  if (profile_.round) {
    const double a = m.out - profile_.centre, length = std::sqrt(a * a + m.up * m.up);
    out = length > 0 ? a / length : 1;
    up = length > 0 ? m.up / length : 0;
  } else if (in == profile_.half_height - std::fabs(m.up)) {
    up = m.up < 0 ? -1 : 1;
  } else {
    out = in == profile_.outer - m.out ? 1 : -1;
  }
  return turned({out * m.at.cos, out * m.at.sin, up});
}

}  // namespace strake::geometry::primitive_pairs
