// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitive_pairs/solvers/torus_depth.hpp"

#include <algorithm>
#include <cmath>

namespace strake::geometry::primitive_pairs {
TorusArcInterior::TorusArcInterior(const Torus& torus, const SweptArc& arc)
    : torus_(torus), spine_(torus.spine(arc)) {
  const SinCos mid = sin_cos(arc.middle());
  const Vec3d outward{mid.cos, mid.sin, 0};
  // A point of the arc lies no farther from the axis than this times what it measures outward.
  const double nearest = (1 + 1e-14) / sin_cos((arc.to - arc.from) / 2).cos;
  // The sector, and what holds of the profile and the ends all over it.
  add({arc.first.sin, -arc.first.cos, 0}, 0, 0);
  add({-arc.last.sin, arc.last.cos, 0}, 0, 0);
  bound_profile(outward, nearest);
  if (!torus.full()) bound_ends(outward, nearest, arc);
}

void TorusArcInterior::add(const Vec3d& local_normal, double weight, double offset) {
  const Vec3d n = torus_.turned(local_normal);
  const double size = 1 + std::fabs(local_normal.x) + std::fabs(local_normal.y);
  fixed_[count_++] = {n, weight, dot(n, torus_.centre()) + offset + torus_.error() * size};
}

void TorusArcInterior::bound_profile(const Vec3d& outward, double nearest) {
  const Profile& p = torus_.profile();
  if (p.round) {
    add({}, 1, p.radius);
    return;
  }
  add({0, 0, 1}, 1, p.half_height);
  add({0, 0, -1}, 1, p.half_height);
  if (!(p.inner > 0)) return;
  add(outward * -nearest, 1, -p.inner);
  add({}, 1, (p.outer - p.inner) / 2);
}

/// Within a right angle of an end its plane is what lies nearest beyond it, farther on the axis.
void TorusArcInterior::bound_ends(const Vec3d& outward, double nearest, const SweptArc& arc) {
  const SinCos end = sin_cos(torus_.angle());
  const double last = torus_.angle() - arc.from;
  if (arc.to <= kPi / 2) add({0, -1, 0}, 1, 0);
  if (last <= kPi / 2) add({-end.sin, end.cos, 0}, 1, 0);
  if (arc.to > kPi / 2 || last > kPi / 2) add(outward * -nearest, 1, 0);
}

DepthProbe TorusArcInterior::probe(const Vec3d& x, double r) const {
  DepthProbe probe;
  probe.certain = certain(x);
  const auto excess = [&](const BallConstraint& c) {
    return dot(c.normal, x) + c.weight * r - c.offset;
  };
  const Profile& p = torus_.profile();
  if (p.round) {
    const GjkResult gap = gjk_distance(point_body(x), spine_);
    const Vec3d n = gap.lower > 0 ? gap.normal : torus_.turned({0, 0, 1});
    probe.cut = half_space(spine_, n, 1);
    probe.cut.offset += p.radius + torus_.error();
  } else {
    const Vec3d v = torus_.local(x);
    const double out = std::sqrt(v.x * v.x + v.y * v.y);
    const Vec3d n = out > 0 ? torus_.turned({v.x / out, v.y / out, 0}) : torus_.turned({1, 0, 0});
    probe.cut = {n, 1, dot(n, torus_.centre()) + p.outer + 2 * torus_.error()};
  }
  double worst = excess(probe.cut);
  for (std::size_t i = 0; i < count_; ++i) {
    const double e = excess(fixed_[i]);
    if (!(e > worst)) continue;
    worst = e;
    probe.cut = fixed_[i];
  }
  return probe;
}

}  // namespace strake::geometry::primitive_pairs
