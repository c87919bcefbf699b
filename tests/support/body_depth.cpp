// SPDX-License-Identifier: Apache-2.0
#include "support/body_depth.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace strake::test {
namespace {

using namespace geometry;

constexpr double kPi = 3.14159265358979323846;
/// Part of the size within which it matters how far outside a point is.
constexpr double kNear = 0.01;

/// Least value of a smooth function over [from, to]: samples, then a narrowing round the best.
template <class F>
double min_over(double from, double to, const F& f) {
  constexpr int kSamples = 60, kThirds = 60;
  double best = from;
  for (int i = 1; i <= kSamples; ++i) {
    const double t = from + (to - from) * i / kSamples;
    if (f(t) < f(best)) best = t;
  }
  const double step = (to - from) / kSamples;
  double lo = best - step, hi = best + step;  // may reach beyond the ends: the curves are closed
  for (int i = 0; i < kThirds; ++i) {
    const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
    (f(a) < f(b) ? hi : lo) = f(a) < f(b) ? b : a;
  }
  return std::min(f(best), f((lo + hi) / 2));
}

/// A body that is what several convex sets have in common is as deep as the least of them.
struct Depth {
  Vec3d p;

  double operator()(const BoxPrimitive& b) const {
    return std::min({b.length_x / 2 - std::fabs(p.x), b.length_y / 2 - std::fabs(p.y),
                     b.length_z / 2 - std::fabs(p.z)});
  }
  double operator()(const PyramidPrimitive& b) const {
    const auto across = [&](double x, double bottom, double top, double offset) {
      const double t = p.z / b.height + 0.5, half = (bottom + t * (top - bottom)) / 2;
      const double slope = (top - bottom) / 2 / b.height, lean = offset / b.height;
      const double from_axis = x - offset * (t - 0.5);
      return std::min((half - from_axis) / std::hypot(1, slope + lean),
                      (half + from_axis) / std::hypot(1, slope - lean));
    };
    return std::min({across(p.x, b.bottom_x, b.top_x, b.offset_x),
                     across(p.y, b.bottom_y, b.top_y, b.offset_y), b.height / 2 - std::fabs(p.z)});
  }
  double operator()(const CylinderPrimitive& c) const {
    return std::min(c.radius - std::hypot(p.x, p.y), c.height / 2 - std::fabs(p.z));
  }
  /// The tangent planes along all generators, and the two end planes.
  double operator()(const SnoutPrimitive& s) const {
    const double t = p.z / s.height + 0.5;
    const double r = s.bottom_radius + t * (s.top_radius - s.bottom_radius);
    const double narrowing = (s.top_radius - s.bottom_radius) / s.height;
    const auto side = [&](double angle) {
      const double c = std::cos(angle), n = std::sin(angle);
      const double out = c * (p.x - s.offset_x * (t - 0.5)) + n * (p.y - s.offset_y * (t - 0.5));
      const double lean = (c * s.offset_x + n * s.offset_y) / s.height;
      return (r - out) / std::hypot(1, lean + narrowing);
    };
    const auto end = [&](double radius, double shear_x, double shear_y, double sign) {
      // A point has no plane.
      const double x = radius > 0 ? std::tan(shear_x) : 0, y = radius > 0 ? std::tan(shear_y) : 0;
      const double over = p.z - sign * s.height / 2 - x * (p.x - sign * s.offset_x / 2) -
                          y * (p.y - sign * s.offset_y / 2);
      return -sign * over / std::sqrt(1 + x * x + y * y);
    };
    const double ends = std::min(end(s.bottom_radius, s.bottom_shear_x, s.bottom_shear_y, -1),
                                 end(s.top_radius, s.top_shear_x, s.top_shear_y, 1));
    return ends < -kNear * s.height ? ends : std::min(ends, min_over(0, 2 * kPi, side));
  }
  double operator()(const SpherePrimitive& s) const {
    return s.diameter / 2 - std::sqrt(dot(p, p));
  }
  double operator()(const EllipticalDishPrimitive& d) const {
    const double out = std::hypot(p.x, p.y), up = std::fabs(p.z);
    const double part = std::hypot(out / d.radius, up / d.height);
    if (p.z < -kNear * d.height || part > 1 + kNear) return std::min(p.z, -kNear * d.height);
    const double to_skin = min_over(0, kPi / 2, [&](double t) {
      return std::hypot(out - d.radius * std::cos(t), up - d.height * std::sin(t));
    });
    return std::min(p.z, part <= 1 ? to_skin : -to_skin);
  }
  double operator()(const SphericalDishPrimitive& d) const {
    const double big = (d.radius * d.radius + d.height * d.height) / (2 * d.height);
    const Vec3d from_centre = p - Vec3d{0, 0, d.height - big};
    return std::min(p.z, big - std::sqrt(dot(from_centre, from_centre)));
  }
  double operator()(const CircularTorusPrimitive& t) const {
    const double tube = t.tube_radius - std::hypot(std::hypot(p.x, p.y) - t.centre_radius, p.z);
    return swept(tube, t.angle, [&](double along, double off) {
      const double beyond = std::max(0.0, std::hypot(along - t.centre_radius, p.z) - t.tube_radius);
      return std::hypot(off, beyond);
    });
  }
  double operator()(const RectangularTorusPrimitive& t) const {
    const double out = std::hypot(p.x, p.y);
    const double outer = std::min(t.outer_radius - out, t.height / 2 - std::fabs(p.z));
    const double profile = t.inner_radius > 0 ? std::min(outer, out - t.inner_radius) : outer;
    return swept(profile, t.angle, [&](double along, double off) {
      const double beyond = std::max({0.0, t.inner_radius - along, along - t.outer_radius});
      return std::hypot(off, beyond, std::max(0.0, std::fabs(p.z) - t.height / 2));
    });
  }
  double operator()(const LinePrimitive&) const { return -1; }

  /// A profile over a sweep; `to_end` is the distance to a flat end, from how far along the plane
  /// of the end and off it the point is.
  template <class ToEnd>
  double swept(double profile, double angle, const ToEnd& to_end) const {
    if (angle >= 2 * kPi - 1e-9) return profile;
    const double c = std::cos(angle), s = std::sin(angle);
    const double ends = std::min(to_end(p.x, p.y), to_end(c * p.x + s * p.y, c * p.y - s * p.x));
    double at = std::atan2(p.y, p.x);
    if (at < 0) at += 2 * kPi;
    if (at > angle) return -ends;
    return profile < 0 ? profile : std::min(profile, ends);
  }
};

}  // namespace

double depth_in(const Primitive& primitive, const Vec3d& p) {
  return std::visit(Depth{p}, primitive);
}

}  // namespace strake::test
