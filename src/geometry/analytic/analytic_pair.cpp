// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/analytic_pair.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "strake/geometry/grid.hpp"

namespace strake::geometry {
namespace {

/// A matrix counts as a scaled rotation, and axes as parallel, when they are off by less than this:
/// what that moves of a surface goes into the error.
constexpr double kSkew = 1e-9;

double norm(const Vec3d& v) { return std::sqrt(dot(v, v)); }

Vec3d column(const Mat3d& m, int k) { return {m.row[0][k], m.row[1][k], m.row[2][k]}; }

/// The scale of a scaled rotation.
std::optional<double> uniform_scale(const Mat3d& m) {
  const Vec3d x = column(m, 0), y = column(m, 1), z = column(m, 2);
  const double sx = norm(x), sy = norm(y), sz = norm(z);
  if (!(sx > 0) || !(sy > 0) || !(sz > 0)) return std::nullopt;
  const double off = std::max({std::fabs(dot(x, y)) / (sx * sy), std::fabs(dot(y, z)) / (sy * sz),
                               std::fabs(dot(z, x)) / (sz * sx), std::fabs(sx - sz) / sz,
                               std::fabs(sy - sz) / sz});
  if (!(off < kSkew)) return std::nullopt;
  return sz;
}

/// A sphere, or a cylinder along `axis` with half its height; about its own centre.
struct Round {
  bool cylinder = false;
  double radius = 0, half = 0;
  Vec3d axis;
  Vec3l centre;
};

std::optional<Round> round_of(const PlacedPrimitive& p) {
  const auto scale = uniform_scale(p.placement->linear);
  const auto centre = snap(p.placement->translation);
  if (!scale || !centre) return std::nullopt;
  const double grid = *scale * kGridPerMm;
  Round r;
  r.centre = *centre;
  if (const auto* sphere = std::get_if<SpherePrimitive>(p.primitive)) {
    r.radius = sphere->diameter / 2 * grid;
  } else if (const auto* cylinder = std::get_if<CylinderPrimitive>(p.primitive)) {
    r.cylinder = true;
    r.radius = cylinder->radius * grid;
    r.half = cylinder->height / 2 * grid;
    r.axis = column(p.placement->linear, 2) * (1 / *scale);
    if (!(r.half > 0)) return std::nullopt;
  } else {
    return std::nullopt;
  }
  if (!(r.radius > 0)) return std::nullopt;
  return r;
}

/// Two intervals or discs along one direction: a about 0, b about `at` >= 0.
struct Overlap {
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
  [[nodiscard]] double a_inside_b() const { return b - a - at; }
  [[nodiscard]] double b_inside_a() const { return a - b - at; }
};

Vec3d unit_or_zero(const Vec3d& v, double size) { return size > 0 ? v * (1 / size) : Vec3d{}; }

AnalyticSeparation spheres(const Round& a, const Round& b, const Vec3d& offset) {
  const double distance = norm(offset);
  const Overlap o{a.radius, b.radius, distance};
  const Vec3d way = unit_or_zero(offset, distance);
  AnalyticSeparation s;
  if (o.gap() >= 0) {
    s.d = o.gap();
    s.point = way * o.middle();
  } else {
    const bool in_a = o.deep_in_a() >= o.deep_in_b();
    s.d = -std::max(o.deep_in_a(), o.deep_in_b());
    s.point = way * (in_a ? o.nearest_to_a() : o.nearest_to_b());
  }
  s.a_inside_b = o.a_inside_b();
  s.b_inside_a = o.b_inside_a();
  s.difference = distance + std::fabs(a.radius - b.radius);
  return s;
}

AnalyticSeparation cylinders(const Round& a, const Round& b, const Vec3d& offset) {
  const double along = dot(offset, a.axis);
  const Vec3d beside = offset - a.axis * along;
  const double distance = norm(beside);
  const Overlap disc{a.radius, b.radius, distance}, bar{a.half, b.half, std::fabs(along)};
  const Vec3d out = unit_or_zero(beside, distance), up = along < 0 ? -a.axis : a.axis;
  AnalyticSeparation s;
  if (disc.gap() >= 0 || bar.gap() >= 0) {
    const double x = std::max(0.0, disc.gap()), z = std::max(0.0, bar.gap());
    s.d = x > 0 && z > 0 ? std::sqrt(x * x + z * z) : std::max(x, z);
    s.point = out * disc.middle() + up * bar.middle();
  } else {
    const double in_a = std::min(disc.deep_in_a(), bar.deep_in_a());
    const double in_b = std::min(disc.deep_in_b(), bar.deep_in_b());
    s.d = -std::max(in_a, in_b);
    s.point = in_a >= in_b ? out * disc.nearest_to_a() + up * bar.nearest_to_a()
                           : out * disc.nearest_to_b() + up * bar.nearest_to_b();
  }
  s.a_inside_b = std::min(disc.a_inside_b(), bar.a_inside_b());
  s.b_inside_a = std::min(disc.b_inside_a(), bar.b_inside_a());
  s.difference = norm(offset) + std::fabs(a.radius - b.radius) + std::fabs(a.half - b.half);
  return s;
}

}  // namespace

std::optional<AnalyticSeparation> analytic_separation(const PlacedPrimitive& a,
                                                      const PlacedPrimitive& b) {
  const auto x = round_of(a), y = round_of(b);
  if (!x || !y || x->cylinder != y->cylinder) return std::nullopt;
  const Vec3d offset = (y->centre - x->centre).as<double>();
  const double reach = norm(offset) + x->radius + y->radius + x->half + y->half;
  double skew = kSkew;
  if (x->cylinder) {
    const double angle = norm(cross(x->axis, y->axis));
    if (!(angle < kSkew)) return std::nullopt;
    skew += angle;
  }
  AnalyticSeparation s = x->cylinder ? cylinders(*x, *y, offset) : spheres(*x, *y, offset);
  s.error = 4 * skew * reach;
  return s;
}

}  // namespace strake::geometry
