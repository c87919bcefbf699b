// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "geometry/tessellate/revolve.hpp"

namespace strake::geometry::tessellation {
namespace {

/// Doubly curved faces grow with the square of this.
constexpr int kMostSegments = 1024;

Vec3d unit(const Vec3d& v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? v * (1 / length) : Vec3d{0, 0, 0};
}

/// Orthonormal local directions whose images are, for a similarity, the world's axes.
struct Basis {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};

Basis world_basis(const Mat3d& linear) {
  const Vec3d z = unit(cross(linear.row[0], linear.row[1]));
  const Vec3d towards_x = cross(linear.row[1], linear.row[2]);
  const Vec3d x = unit(towards_x - z * dot(z, towards_x));
  if (dot(z, z) < 0.5 || dot(x, x) < 0.5) return {};
  return {x, cross(z, x), z};
}

Sweep full_circle(int segments, const SinCos& phase) { return {rim(segments, phase), true}; }

/// A dome over a base disc: the profile runs from the base to the pole.
Tessellation dome(const std::vector<ProfilePoint>& profile, int segments, const Target& target,
                  double sag) {
  const Sweep sweep =
      full_circle(segments, canonical_phase(column(target.linear, 0), column(target.linear, 1)));
  Builder builder;
  const auto grid = revolve(builder, sweep, profile.size(), false,
                            [&](std::size_t i, std::size_t) { return profile[i]; });
  builder.polygon(grid[0], true);
  return std::move(builder).take(sag, true);
}

/// Only the base disc: a surface.
Tessellation disc(double radius, const Target& target) {
  const int n = circle_segments(radius, kRimShare * target.sag);
  Builder builder;
  std::vector<std::uint32_t> ring;
  for (const SinCos& a :
       rim(n, canonical_phase(column(target.linear, 0), column(target.linear, 1))))
    ring.push_back(builder.vertex({radius * a.cos, radius * a.sin, 0}));
  builder.polygon(ring);
  return std::move(builder).take(sagitta(radius, 2 * kPi / n), true);
}

}  // namespace

Tessellation make(const SpherePrimitive& p, const Target& target) {
  if (!are_lengths({p.diameter})) return fault("a length is negative or not finite");
  if (p.diameter == 0) return fault("a sphere of no diameter");
  const double radius = p.diameter / 2;
  const int n = circle_segments(radius, kRimShare * target.sag, kMostSegments);
  const double rim_sag = sagitta(radius, 2 * kPi / n);
  const int half = arc_segments(radius, kPi / 2, target.sag - rim_sag, kMostSegments / 4);
  const int rows = 2 * std::max(half, 2);
  const Sweep sweep = full_circle(n, {0, 1});
  Builder builder;
  // From pole to pole; both halves from the same sines.
  (void)revolve(builder, sweep, static_cast<std::size_t>(rows) + 1, false,
                [&](std::size_t i, std::size_t) {
                  const int k = static_cast<int>(i) - rows / 2;
                  const SinCos a = sin_cos(kPi * std::abs(k) / rows);
                  const bool pole = std::abs(k) == rows / 2;
                  return ProfilePoint{pole ? 0 : radius * a.cos,
                                      (k < 0 ? -radius : radius) * (pole ? 1 : a.sin)};
                });
  Tessellation t = std::move(builder).take(rim_sag + sagitta(radius, kPi / rows), true);
  const Basis b = world_basis(target.linear);
  for (Vec3d& v : t.mesh.vertices) v = b.x * v.x + b.y * v.y + b.z * v.z;
  return t;
}

Tessellation make(const EllipticalDishPrimitive& p, const Target& target) {
  if (!are_lengths({p.radius, p.height})) return fault("a length is negative or not finite");
  if (p.radius == 0) return fault("a dish of no radius");
  if (p.height == 0) return disc(p.radius, target);
  const int n = circle_segments(p.radius, kRimShare * target.sag, kMostSegments);
  const double rim_sag = sagitta(p.radius, 2 * kPi / n);
  // A chord over the parameter step t strays by at most |second derivative|·t²/8.
  const double axis = std::max(p.radius, p.height), rest = target.sag - rim_sag;
  const double wanted = kPi / 2 * std::sqrt(axis / (8 * rest));
  constexpr int kMostRows = kMostSegments / 4;
  const int rows = wanted < kMostRows ? std::max(2, static_cast<int>(wanted) + 1) : kMostRows;
  std::vector<ProfilePoint> profile;
  for (int k = 0; k < rows; ++k) {
    const SinCos a = sin_cos(kPi / 2 * k / rows);
    profile.push_back({p.radius * a.cos, p.height * a.sin});
  }
  profile.push_back({0, p.height});
  const double step = kPi / 2 / rows;
  return dome(profile, n, target, rim_sag + axis * step * step / 8);
}

Tessellation make(const SphericalDishPrimitive& p, const Target& target) {
  if (!are_lengths({p.radius, p.height})) return fault("a length is negative or not finite");
  if (p.radius == 0) return fault("a dish of no radius");
  if (p.height == 0) return disc(p.radius, target);
  const double radius = (p.radius / p.height * p.radius + p.height) / 2;
  const double from_apex = 2 * arc_tan2(p.height, p.radius);
  const double equator = p.height > p.radius ? radius : p.radius;
  const int n = circle_segments(equator, kRimShare * target.sag, kMostSegments);
  const double rim_sag = sagitta(equator, 2 * kPi / n);
  const int rows =
      std::max(2, arc_segments(radius, from_apex, target.sag - rim_sag, kMostSegments / 2));
  std::vector<ProfilePoint> profile{{p.radius, 0}};
  for (int k = 1; k < rows; ++k) {
    // Depth under the apex without cancellation: radius·(1 - cos) = the sagitta of twice the angle.
    const double angle = from_apex * (rows - k) / rows;
    profile.push_back({radius * sin_cos(angle).sin, p.height - sagitta(radius, 2 * angle)});
  }
  profile.push_back({0, p.height});
  return dome(profile, n, target, rim_sag + sagitta(radius, from_apex / rows));
}

}  // namespace strake::geometry::tessellation
