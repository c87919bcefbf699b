// SPDX-License-Identifier: Apache-2.0
#include "support/true_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace strake::test {
namespace {

using namespace geometry;

constexpr double kPi = 3.14159265358979323846;
constexpr double kFar = 1e300;
constexpr double kSlack = 1e-9;

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3d polar(double radius, double angle, double z) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

double radius_of(const Vec3d& p) { return std::hypot(p.x, p.y); }

bool swept(const Vec3d& p, double angle) {
  double a = std::atan2(p.y, p.x);
  if (a < -1e-7) a += 2 * kPi;
  return angle >= 2 * kPi - 1e-6 || a <= angle + 1e-7;
}

/// Distance of p to the plane of the cap at `angle`, and its place in that cap.
struct CapPlace {
  double distance = 0, radius = 0, z = 0;
};
std::array<CapPlace, 2> cap_places(const Vec3d& p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{{std::fabs(p.y), p.x, p.z}, {std::fabs(-s * p.x + c * p.y), c * p.x + s * p.y, p.z}}};
}

struct Points {
  std::mt19937_64& random;

  Vec3d operator()(const BoxPrimitive& b) const {
    return (*this)(
        PyramidPrimitive{b.length_x, b.length_y, b.length_x, b.length_y, 0, 0, b.length_z});
  }
  Vec3d operator()(const PyramidPrimitive& p) const {
    const auto face = random() % 6;
    double u = uniform(random, -0.5, 0.5), v = uniform(random, -0.5, 0.5);
    double t = uniform(random, 0, 1);
    if (face < 2) t = static_cast<double>(face);
    if (face == 2 || face == 3) u = face == 2 ? -0.5 : 0.5;
    if (face > 3) v = face == 4 ? -0.5 : 0.5;
    return {p.offset_x * (t - 0.5) + u * (p.bottom_x + t * (p.top_x - p.bottom_x)),
            p.offset_y * (t - 0.5) + v * (p.bottom_y + t * (p.top_y - p.bottom_y)),
            p.height * (t - 0.5)};
  }
  Vec3d operator()(const CylinderPrimitive& c) const {
    SnoutPrimitive s;
    s.bottom_radius = s.top_radius = c.radius;
    s.height = c.height;
    return (*this)(s);
  }
  Vec3d operator()(const SnoutPrimitive& s) const {
    // A point of the solid's skin: on the cone between the end planes, or on an end plane in it.
    for (;;) {
      const double a = uniform(random, 0, 2 * kPi), t = uniform(random, -2, 3);
      const double f = random() % 3 == 0 ? std::sqrt(uniform(random, 0, 1)) : 1;
      const double r = s.bottom_radius + t * (s.top_radius - s.bottom_radius);
      if (r < 0) continue;
      Vec3d p = polar(r * f, a, 0) +
                Vec3d{s.offset_x * (t - 0.5), s.offset_y * (t - 0.5), s.height * (t - 0.5)};
      const bool below = above_bottom(s, p) < 0, above = above_top(s, p) > 0;
      if (f == 1 && !below && !above) return p;
      if (f != 1) {
        // Slide along the generator-like line through p to an end plane.
        const bool to_top = random() % 2 == 0;
        for (int i = 0; i < 100; ++i) {
          const double gap = to_top ? above_top(s, p) : above_bottom(s, p);
          p = p - Vec3d{0, 0, gap};
        }
        if (distance_in_section(s, p) <= 0) return p;
      }
    }
  }
  Vec3d operator()(const SpherePrimitive& s) const {
    const double z = uniform(random, -1, 1);
    return polar(std::sqrt(1 - z * z), uniform(random, 0, 2 * kPi), z) * (s.diameter / 2);
  }
  Vec3d operator()(const EllipticalDishPrimitive& d) const {
    const double a = uniform(random, 0, 2 * kPi);
    if (random() % 4 == 0) return polar(d.radius * std::sqrt(uniform(random, 0, 1)), a, 0);
    const double t = uniform(random, 0, kPi / 2);
    return polar(d.radius * std::cos(t), a, d.height * std::sin(t));
  }
  Vec3d operator()(const SphericalDishPrimitive& d) const {
    const double a = uniform(random, 0, 2 * kPi);
    if (random() % 4 == 0) return polar(d.radius * std::sqrt(uniform(random, 0, 1)), a, 0);
    const double r = (d.radius * d.radius + d.height * d.height) / (2 * d.height);
    const double t = uniform(random, 0, 2 * std::atan(d.height / d.radius));
    return polar(r * std::sin(t), a, d.height - r + r * std::cos(t));
  }
  Vec3d operator()(const CircularTorusPrimitive& t) const {
    for (;;) {
      const double phi = uniform(random, 0, 2 * kPi);
      double sweep = uniform(random, 0, t.angle), f = 1;
      if (random() % 4 == 0 && t.angle < 2 * kPi) {
        sweep = random() % 2 == 0 ? 0 : t.angle;
        f = std::sqrt(uniform(random, 0, 1));
      }
      const double r = t.centre_radius + f * t.tube_radius * std::cos(phi);
      if (r >= 0) return polar(r, sweep, f * t.tube_radius * std::sin(phi));
    }
  }
  Vec3d operator()(const RectangularTorusPrimitive& t) const {
    double r = uniform(random, t.inner_radius, t.outer_radius);
    double z = uniform(random, -t.height / 2, t.height / 2);
    double sweep = uniform(random, 0, t.angle);
    switch (random() % 5) {
      case 0:
        // The axis of a full turn lies inside.
        r = t.inner_radius == 0 && t.angle >= 2 * kPi ? t.outer_radius : t.inner_radius;
        break;
      case 1:
        r = t.outer_radius;
        break;
      case 2:
        z = t.height / 2;
        break;
      case 3:
        z = -t.height / 2;
        break;
      default:
        if (t.angle < 2 * kPi)
          sweep = random() % 2 == 0 ? 0 : t.angle;
        else
          r = t.outer_radius;
    }
    return polar(r, sweep, z);
  }
  Vec3d operator()(const LinePrimitive&) const { return {}; }

  static double above_bottom(const SnoutPrimitive& s, const Vec3d& p) {
    if (s.bottom_radius == 0) return p.z + s.height / 2;  // a point has no plane
    return p.z + s.height / 2 - std::tan(s.bottom_shear_x) * (p.x + s.offset_x / 2) -
           std::tan(s.bottom_shear_y) * (p.y + s.offset_y / 2);
  }
  static double above_top(const SnoutPrimitive& s, const Vec3d& p) {
    if (s.top_radius == 0) return p.z - s.height / 2;
    return p.z - s.height / 2 - std::tan(s.top_shear_x) * (p.x - s.offset_x / 2) -
           std::tan(s.top_shear_y) * (p.y - s.offset_y / 2);
  }
  /// Horizontal distance outside the cone; negative inside.
  static double distance_in_section(const SnoutPrimitive& s, const Vec3d& p) {
    const double t = p.z / s.height + 0.5;
    const double r = s.bottom_radius + t * (s.top_radius - s.bottom_radius);
    return std::hypot(p.x - s.offset_x * (t - 0.5), p.y - s.offset_y * (t - 0.5)) - r;
  }
};

struct Distance {
  Vec3d p;

  double operator()(const BoxPrimitive& b) const {
    return (*this)(
        PyramidPrimitive{b.length_x, b.length_y, b.length_x, b.length_y, 0, 0, b.length_z});
  }
  double operator()(const PyramidPrimitive& b) const {
    const double t = p.z / b.height + 0.5;
    const double half_x = (b.bottom_x + t * (b.top_x - b.bottom_x)) / 2;
    const double half_y = (b.bottom_y + t * (b.top_y - b.bottom_y)) / 2;
    const double x = std::fabs(p.x - b.offset_x * (t - 0.5)) - half_x;
    const double y = std::fabs(p.y - b.offset_y * (t - 0.5)) - half_y;
    const double z = std::fabs(p.z) - b.height / 2;
    return std::fabs(std::max({x, y, z}));
  }
  double operator()(const CylinderPrimitive& c) const {
    const double r = radius_of(p) - c.radius, z = std::fabs(p.z) - c.height / 2;
    return std::min(z <= kSlack ? std::fabs(r) : kFar, r <= kSlack ? std::fabs(z) : kFar);
  }
  double operator()(const SnoutPrimitive& s) const {
    const double outside = Points::distance_in_section(s, p);
    if (outside > kSlack) return outside;
    return std::min({std::fabs(outside), std::fabs(Points::above_bottom(s, p)),
                     std::fabs(Points::above_top(s, p))});
  }
  double operator()(const SpherePrimitive& s) const {
    return std::fabs(std::sqrt(dot(p, p)) - s.diameter / 2);
  }
  double operator()(const EllipticalDishPrimitive& d) const {
    const double r = radius_of(p);
    double best = r <= d.radius + kSlack ? std::fabs(p.z) : kFar;
    const double inside_r = 1 - r * r / (d.radius * d.radius);
    const double inside_z = 1 - p.z * p.z / (d.height * d.height);
    if (inside_r >= 0) best = std::min(best, std::fabs(p.z - d.height * std::sqrt(inside_r)));
    if (inside_z >= 0) best = std::min(best, std::fabs(r - d.radius * std::sqrt(inside_z)));
    const double k = std::hypot(r / d.radius, p.z / d.height);
    if (k > 0) best = std::min(best, std::sqrt(dot(p, p)) * std::fabs(1 / k - 1));
    return best;
  }
  double operator()(const SphericalDishPrimitive& d) const {
    const double big = (d.radius * d.radius + d.height * d.height) / (2 * d.height);
    const Vec3d c = p - Vec3d{0, 0, d.height - big};
    const double cap = p.z >= -kSlack ? std::fabs(std::sqrt(dot(c, c)) - big) : kFar;
    return std::min(cap, radius_of(p) <= d.radius + kSlack ? std::fabs(p.z) : kFar);
  }
  double operator()(const CircularTorusPrimitive& t) const {
    double best = swept(p, t.angle)
                      ? std::fabs(std::hypot(radius_of(p) - t.centre_radius, p.z) - t.tube_radius)
                      : kFar;
    if (t.angle < 2 * kPi)
      for (const CapPlace& c : cap_places(p, t.angle))
        if (std::hypot(c.radius - t.centre_radius, c.z) <= t.tube_radius + kSlack)
          best = std::min(best, c.distance);
    return best;
  }
  double operator()(const RectangularTorusPrimitive& t) const {
    const double r = radius_of(p), z = std::fabs(p.z) - t.height / 2;
    double best = kFar;
    if (swept(p, t.angle)) {
      if (z <= kSlack)
        best = std::min(std::fabs(r - t.inner_radius), std::fabs(r - t.outer_radius));
      if (r >= t.inner_radius - kSlack && r <= t.outer_radius + kSlack)
        best = std::min(best, std::fabs(z));
      // A chord of the inner wall leaves the annulus by its sagitta.
      if (r < t.inner_radius)
        best = std::min(best, std::hypot(t.inner_radius - r, std::max(z, 0.0)));
    }
    if (t.angle < 2 * kPi)
      for (const CapPlace& c : cap_places(p, t.angle))
        if (c.radius >= t.inner_radius - kSlack && c.radius <= t.outer_radius + kSlack &&
            z <= kSlack)
          best = std::min(best, c.distance);
    return best;
  }
  double operator()(const LinePrimitive&) const { return 0; }
};

/// Closest point of a triangle: the plane when it falls inside, else the nearest edge.
double distance_to_triangle(const Vec3d& p, const std::array<Vec3d, 3>& t) {
  const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
  const double square = dot(n, n);
  double best = kFar;
  bool inside = square > 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d &a = t[k], &b = t[(k + 1) % 3];
    const Vec3d ab = b - a, ap = p - a;
    if (dot(cross(ab, ap), n) < 0) inside = false;
    const double length = dot(ab, ab);
    const double s = length > 0 ? std::clamp(dot(ap, ab) / length, 0.0, 1.0) : 0;
    const Vec3d gap = ap - ab * s;
    best = std::min(best, std::sqrt(dot(gap, gap)));
  }
  if (inside) best = std::min(best, std::fabs(dot(p - t[0], n)) / std::sqrt(square));
  return best;
}

}  // namespace

std::vector<Vec3d> surface_points(const Primitive& primitive, std::size_t count,
                                  std::mt19937_64& random) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(std::visit(Points{random}, primitive));
  return points;
}

std::vector<Vec3d> snout_outlines(const SnoutPrimitive& s, std::size_t count) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * kPi * static_cast<double>(i) / static_cast<double>(count);
    const auto at = [&](double t) {
      return polar(s.bottom_radius + t * (s.top_radius - s.bottom_radius), angle, 0) +
             Vec3d{s.offset_x * (t - 0.5), s.offset_y * (t - 0.5), s.height * (t - 0.5)};
    };
    // Along a generator the height over a plane is linear.
    for (const auto above : {Points::above_bottom, Points::above_top}) {
      const double from = above(s, at(0)), to = above(s, at(1));
      points.push_back(at(from / (from - to)));
    }
  }
  return points;
}

double distance_to_primitive(const Primitive& primitive, const Vec3d& p) {
  return std::visit(Distance{p}, primitive);
}

double distance_to_mesh(const TriangleMesh& mesh, const Vec3d& p) {
  double best = kFar;
  for (const Triangle& t : mesh.triangles)
    best = std::min(best, distance_to_triangle(
                              p, {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}));
  return best;
}

}  // namespace strake::test
