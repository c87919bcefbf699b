// SPDX-License-Identifier: Apache-2.0
#include "clash/narrow_phase/witness.hpp"

#include <cmath>

namespace strake::clash {
namespace {

using geometry::PartKind;
using geometry::PartWithBvh;
using geometry::SurfacePoint;
using geometry::Vec3d;

/// A distance below this is rounding, grid units: it gives no direction between two points.
constexpr double kMinLength = 1.0 / 64;

/// Returns the direction from the deepest point to the surface; where they all but coincide, out
/// through the surface.
Vec3d exit_direction(const Vec3d& deepest, const SurfacePoint& surface) {
  const Vec3d way = surface.point - deepest;
  const double length = std::sqrt(dot(way, way));
  return length < kMinLength ? surface.normal : way * (1 / length);
}

}  // namespace

Witness witness_of_touch(const Vec3d& point) { return {.on_a = point, .on_b = point}; }

Witness witness_of_slab(const Vec3d& point, const Vec3d& normal, double d) {
  if (!(d < 0)) return witness_of_touch(point);
  return {.on_a = point, .on_b = point - normal * d, .away = normal, .interiors_meet = true};
}

Witness witness_of_gap(const geometry::ClosestPair& closest) {
  const Vec3d way = closest.on_a - closest.on_b;
  const double length = std::sqrt(dot(way, way));
  return {.on_a = closest.on_a,
          .on_b = closest.on_b,
          .away = length > 0 ? way * (1 / length) : Vec3d{}};
}

Witness witness_of(const geometry::PrimitiveSeparation& s, const Vec3d& point) {
  if (!(s.d < 0)) {
    const Vec3d half = s.away * (s.d / 2);
    return {.on_a = point + half, .on_b = point - half, .away = s.away};
  }
  const Vec3d whole = s.away * -s.d;
  Witness w{.on_a = point, .on_b = point, .away = s.away, .interiors_meet = true};
  w.deep_in_a = s.deep_in_a;
  if (s.deep_in_a)
    w.on_a = point - whole;
  else
    w.on_b = point + whole;
  return w;
}

Witness witness_of_depth(const PartWithBvh& a, const PartWithBvh& b, const Vec3d& deepest) {
  Witness w{.on_a = deepest, .on_b = deepest, .interiors_meet = true};
  const bool solid_a = a.placed.part->kind == PartKind::solid;
  const bool solid_b = b.placed.part->kind == PartKind::solid;
  const Vec3d shift = (b.placed.origin - a.placed.origin).as<double>();
  const SurfacePoint in_a = solid_a ? nearest_on_surface(a, deepest) : SurfacePoint{};
  const SurfacePoint in_b = solid_b ? nearest_on_surface(b, deepest - shift) : SurfacePoint{};
  w.deep_in_a = solid_a && (!solid_b || in_a.distance >= in_b.distance);
  if (w.deep_in_a) {
    w.on_a = in_a.point;
    w.away = -exit_direction(deepest, in_a);
  } else if (solid_b) {
    w.on_b = in_b.point + shift;
    w.away = exit_direction(deepest - shift, in_b);
  }
  return w;
}

Witness mirrored(const Witness& w, const Vec3d& shift) {
  return {.on_a = w.on_b + shift,
          .on_b = w.on_a + shift,
          .away = -w.away,
          .interiors_meet = w.interiors_meet,
          .deep_in_a = w.interiors_meet && !w.deep_in_a};
}

}  // namespace strake::clash
