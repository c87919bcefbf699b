// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "geometry/primitive_pairs/pair_solvers.hpp"
#include "geometry/primitive_pairs/shapes/rigid_primitive.hpp"

namespace strake::geometry::primitive_pairs {
namespace {

/// Two intervals or discs along one direction: a about 0, b about `at` >= 0.
struct ClosedFormDepth {
  double a = 0, b = 0, at = 0;

  [[nodiscard]] double gap() const { return at - a - b; }
  /// Where they meet most evenly: the middle of the common part or of the gap.
  [[nodiscard]] double middle() const { return (std::min(a, at + b) + std::max(-a, at - b)) / 2; }
  /// The place of b nearest to a's centre, and of a nearest to b's.
  [[nodiscard]] double nearest_to_a() const { return std::max(0.0, at - b); }
  [[nodiscard]] double nearest_to_b() const { return std::min(at, a); }
  /// How deep b reaches into a, and a into b.
  [[nodiscard]] double deep_in_a() const { return a - nearest_to_a(); }
  [[nodiscard]] double deep_in_b() const { return b - (at - nearest_to_b()); }
  /// The middle of what is common and at least so deep in a, or in b.
  [[nodiscard]] double middle_deep_in_a(double depth) const {
    return ClosedFormDepth{a - depth, b, at}.middle();
  }
  [[nodiscard]] double middle_deep_in_b(double depth) const {
    return ClosedFormDepth{a, b - depth, at}.middle();
  }
  [[nodiscard]] double a_inside_b() const { return b - a - at; }
  [[nodiscard]] double b_inside_a() const { return a - b - at; }
};

Vec3d unit_or_zero(const Vec3d& v, double size) { return size > 0 ? v * (1 / size) : Vec3d{}; }

/// Concentric: every direction out of a ball is equally short.
Vec3d unit_or_x(const Vec3d& v) {
  const double size = norm(v);
  return size > 0 ? v * (1 / size) : Vec3d{1, 0, 0};
}

PrimitiveSeparation spheres(const RigidPrimitive& a, const RigidPrimitive& b, const Vec3d& offset) {
  const double distance = norm(offset);
  const ClosedFormDepth o{a.half[0], b.half[0], distance};
  const Vec3d way = unit_or_zero(offset, distance);
  PrimitiveSeparation s;
  s.away = -unit_or_x(offset);
  if (o.gap() >= 0) {
    s.d = o.gap();
    s.point = way * o.middle();
  } else {
    s.deep_in_a = o.deep_in_a() >= o.deep_in_b();
    s.d = -std::max(o.deep_in_a(), o.deep_in_b());
    s.point = way * (s.deep_in_a ? o.nearest_to_a() : o.nearest_to_b());
  }
  s.a_inside_b = o.a_inside_b();
  s.b_inside_a = o.b_inside_a();
  s.difference = distance + std::fabs(a.half[0] - b.half[0]);
  return s;
}

PrimitiveSeparation cylinders(const RigidPrimitive& a, const RigidPrimitive& b,
                              const Vec3d& offset) {
  const Vec3d& axis = a.axes[2];
  const double along = dot(offset, axis);
  const Vec3d beside = offset - axis * along;
  const double distance = norm(beside);
  const ClosedFormDepth disc{a.half[0], b.half[0], distance},
      bar{a.half[2], b.half[2], std::fabs(along)};
  const Vec3d out = unit_or_zero(beside, distance), up = along < 0 ? -axis : axis;
  PrimitiveSeparation s;
  if (disc.gap() >= 0 || bar.gap() >= 0) {
    const double x = std::max(0.0, disc.gap()), z = std::max(0.0, bar.gap());
    s.d = x > 0 && z > 0 ? std::sqrt(x * x + z * z) : std::max(x, z);
    s.point = out * disc.middle() + up * bar.middle();
    const Vec3d gap = out * x + up * z;
    s.away = -unit_or_x(s.d > 0 ? gap : disc.gap() >= 0 ? out : up);
  } else {
    const double in_a = std::min(disc.deep_in_a(), bar.deep_in_a());
    const double in_b = std::min(disc.deep_in_b(), bar.deep_in_b());
    s.d = -std::max(in_a, in_b);
    s.deep_in_a = in_a >= in_b;
    s.point = s.deep_in_a ? out * disc.middle_deep_in_a(in_a) + up * bar.middle_deep_in_a(in_a)
                          : out * disc.middle_deep_in_b(in_b) + up * bar.middle_deep_in_b(in_b);
    const bool by_end =
        s.deep_in_a ? bar.deep_in_a() < disc.deep_in_a() : bar.deep_in_b() < disc.deep_in_b();
    s.away = by_end ? -up : distance > 0 ? -out : a.axes[0];
  }
  s.a_inside_b = std::min(disc.a_inside_b(), bar.a_inside_b());
  s.b_inside_a = std::min(disc.b_inside_a(), bar.b_inside_a());
  s.difference = norm(offset) + std::fabs(a.half[0] - b.half[0]) + std::fabs(a.half[2] - b.half[2]);
  return s;
}

/// A box or a cylinder as what a sphere sees of it: the sphere's centre measured along two or three
/// directions at right angles, in each of which the body reaches from 0 (or -half) to half.
struct Slabs {
  std::array<double, 3> at{}, half{};
  std::array<Vec3d, 3> way{};  ///< unit; `at` >= 0 along it
  std::size_t count = 0;

  void add(double place, double half_length, const Vec3d& direction) {
    at[count] = std::fabs(place);
    half[count] = half_length;
    way[count++] = place < 0 ? -direction : direction;
  }
  /// Where the body shrunk by t on all sides comes nearest to the sphere's centre.
  [[nodiscard]] Vec3d nearest(double t) const {
    Vec3d p;
    for (std::size_t k = 0; k < count; ++k) p = p + way[k] * std::min(at[k], half[k] - t);
    return p;
  }
  /// The face that this place lies nearest to.
  [[nodiscard]] std::size_t nearest_face(double t) const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < count; ++k)
      if (half[k] - std::min(at[k], half[k] - t) < half[best] - std::min(at[best], half[best] - t))
        best = k;
    return best;
  }
  [[nodiscard]] double squared_distance(double t) const {
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double beyond = std::max(0.0, at[k] - half[k] + t);
      sum += beyond * beyond;
    }
    return sum;
  }
};

Slabs slabs_of(const RigidPrimitive& body, const Vec3d& centre) {
  Slabs s;
  if (body.kind == RigidPrimitive::Kind::box) {
    for (std::size_t k = 0; k < 3; ++k)
      s.add(dot(centre, body.axes[k]), body.half[k], body.axes[k]);
    return s;
  }
  const double along = dot(centre, body.axes[2]);
  const Vec3d beside = centre - body.axes[2] * along;
  const double distance = norm(beside);
  s.add(distance, body.half[0], distance > 0 ? beside * (1 / distance) : body.axes[0]);
  s.add(along, body.half[2], body.axes[2]);
  return s;
}

/// How deep in the body the deepest point of the ball lies that is in the body: the greatest t for
/// which the body shrunk by t still comes within `radius` of the centre. The squared distance grows
/// with t as a parabola through each set of slabs that the centre lies beyond.
double deepest_of_ball(const Slabs& s, double radius) {
  const auto slabs = std::span(s.half).first(s.count);
  const double largest = *std::min_element(slabs.begin(), slabs.end());
  if (s.squared_distance(largest) <= radius * radius) return largest;
  std::array<double, 3> beyond{};
  for (std::size_t k = 0; k < s.count; ++k) beyond[k] = s.at[k] - s.half[k];
  std::sort(beyond.begin(), beyond.begin() + static_cast<std::ptrdiff_t>(s.count),
            [](double x, double y) { return x > y; });
  double sum = 0, squares = 0, t = largest;
  for (std::size_t m = 0; m < s.count; ++m) {
    sum += beyond[m];
    squares += beyond[m] * beyond[m];
    const auto n = static_cast<double>(m + 1);
    const double root = sum * sum - n * (squares - radius * radius);
    t = (std::sqrt(std::max(0.0, root)) - sum) / n;
    if (m + 1 == s.count || t <= -beyond[m + 1]) break;
  }
  return std::clamp(t, 0.0, largest);
}

double farthest(const Slabs& s) {
  double sum = 0;
  for (std::size_t k = 0; k < s.count; ++k) sum += (s.at[k] + s.half[k]) * (s.at[k] + s.half[k]);
  return std::sqrt(sum);
}

/// A sphere, called a, against a box or cylinder; the point is relative to the body's centre.
PrimitiveSeparation sphere_and_body(const RigidPrimitive& sphere, const RigidPrimitive& body,
                                    const Vec3d& centre) {
  const Slabs slabs = slabs_of(body, centre);
  const double radius = sphere.half[0], distance = std::sqrt(slabs.squared_distance(0));
  const Vec3d nearest = slabs.nearest(0);
  PrimitiveSeparation s;
  if (distance >= radius) {
    s.d = distance - radius;
    s.point = nearest + (centre - nearest) * (s.d / (2 * distance));
    s.away = unit_or_x(centre - nearest);
  } else {
    const double in_body = deepest_of_ball(slabs, radius), in_sphere = radius - distance;
    s.d = -std::max(in_body, in_sphere);
    s.deep_in_a = in_sphere >= in_body;
    s.point = s.deep_in_a ? nearest : slabs.nearest(in_body);
    s.away = s.deep_in_a ? unit_or_x(centre - nearest) : slabs.way[slabs.nearest_face(in_body)];
  }
  s.a_inside_b = -radius - distance;
  if (!(distance > 0)) {
    double room = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < slabs.count; ++k)
      room = std::min(room, slabs.half[k] - slabs.at[k]);
    s.a_inside_b = room - radius;
  }
  s.b_inside_a = radius - farthest(slabs);
  s.difference = norm(centre) + radius + body.half[0] + body.half[1] + body.half[2];
  return s;
}

double size_of(const RigidPrimitive& s) {
  if (s.kind == RigidPrimitive::Kind::sphere) return s.half[0];
  return s.half[0] + s.half[1] + s.half[2];
}

/// Nothing for a pair that has no closed form. `tilt` is what b's axis is turned by to be a's.
std::optional<PrimitiveSeparation> by_kinds(const RigidPrimitive& a, const RigidPrimitive& b,
                                            double& tilt) {
  using Kind = RigidPrimitive::Kind;
  const Vec3d offset = (b.centre - a.centre).as<double>();
  if (a.kind == Kind::sphere && b.kind == Kind::sphere) return spheres(a, b, offset);
  if (a.kind == Kind::cylinder && b.kind == Kind::cylinder) {
    tilt = norm(cross(a.axes[2], b.axes[2]));
    return cylinders(a, b, offset);
  }
  if (b.kind == Kind::sphere) {
    PrimitiveSeparation s = sphere_and_body(b, a, offset);
    std::swap(s.a_inside_b, s.b_inside_a);
    s.away = -s.away;
    s.deep_in_a = s.d < 0 && !s.deep_in_a;
    return s;
  }
  if (a.kind != Kind::sphere) return std::nullopt;
  PrimitiveSeparation s = sphere_and_body(a, b, -offset);
  s.point = s.point + offset;
  return s;
}

}  // namespace

std::optional<PrimitiveSeparation> closed_form(const PlacedPrimitive& a, const PlacedPrimitive& b) {
  const auto x = rigid_primitive(a), y = rigid_primitive(b);
  if (!x || !y) return std::nullopt;
  double tilt = 0;
  auto s = by_kinds(*x, *y, tilt);
  if (!s) return std::nullopt;
  const double reach = norm((y->centre - x->centre).as<double>()) + size_of(*x) + size_of(*y);
  // The sine of a tilt this small is the angle, and the chord, but for a part in 10^4.
  const double turned = 1.001 * tilt * size_of(*y);
  if (!(tilt < 0.01) || !(turned < kMaxOrthonormalError)) return std::nullopt;
  const double error =
      x->error + y->error + turned + 64 * std::numeric_limits<double>::epsilon() * reach;
  s->lower = s->d - error;
  s->upper = s->d + error;
  // Open whether they are apart: a touch, as far as this can tell.
  if (s->d > 0 && !(s->lower > 0)) s->d = 0;
  return s;
}

}  // namespace strake::geometry::primitive_pairs
