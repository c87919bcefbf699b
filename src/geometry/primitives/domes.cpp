// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitives/domes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "geometry/primitives/mesh_builder.hpp"

namespace strake::geometry::tessellation {
namespace {

/// Doubly curved faces grow with the square of this.
constexpr int kMaxDomeSegments = 1024;

Vec3d unit_or_zero(const Vec3d& v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? v * (1 / length) : Vec3d{0, 0, 0};
}

/// Orthonormal local directions whose images are, for a similarity, the world's axes.
struct Basis {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
};

Basis world_basis(const Mat3d& linear) {
  const Vec3d z = unit_or_zero(cross(linear.row[0], linear.row[1]));
  const Vec3d towards_x = cross(linear.row[1], linear.row[2]);
  const Vec3d x = unit_or_zero(towards_x - z * dot(z, towards_x));
  if (dot(z, z) < 0.5 || dot(x, x) < 0.5) return {};
  return {x, cross(z, x), z};
}

/// The same with z towards the viewer, so that the contour is an equator.
Basis view_basis(const Mat3d& linear, const Vec3d& towards) {
  const Basis world = world_basis(linear);
  const bool steep = std::fabs(dot(world.z, towards)) > 0.9;
  const Vec3d helper = steep ? world.x : world.z;
  const Vec3d x = unit_or_zero(helper - towards * dot(helper, towards));
  return {x, cross(towards, x), towards};
}

/// Returns the basis whose z points to the eye, and how far away that is; none in the ball.
struct BallFromEye {
  Basis basis;
  double distance = 0;

  [[nodiscard]] static std::optional<BallFromEye> of(const TessellationTarget& target,
                                                     double radius) {
    if (!target.eye) return std::nullopt;
    const double distance = std::sqrt(dot(*target.eye, *target.eye));
    if (!(distance > kNearestEye * radius)) return std::nullopt;
    return BallFromEye{view_basis(target.linear, *target.eye * (1 / distance)), distance};
  }

  /// Returns the latitudes of the rows between the poles, the contour among them.
  [[nodiscard]] std::vector<double> latitudes(double radius, int rows) const {
    const double contour = arc_sin(radius / distance);
    const auto parts = [&](double span) {
      return std::max(1, static_cast<int>(std::ceil(span / kPi * rows * (1 - 1e-9))));
    };
    const int below = parts(kPi / 2 + contour), above = parts(kPi / 2 - contour);
    std::vector<double> all;
    for (int k = 1; k <= below; ++k) all.push_back(-kPi / 2 + (kPi / 2 + contour) * k / below);
    for (int k = 1; k < above; ++k) all.push_back(contour + (kPi / 2 - contour) * k / above);
    return all;
  }
};

/// Returns how far the chords of a circle are from it.
double sag_of_rim(const TessellationTarget& target, double radius, const std::vector<SinCos>& rim) {
  const double even = 2 * kPi / static_cast<double>(rim.size());
  return sagitta(radius, target.eye ? widest_step(rim) : even);
}

/// A dome over a base disc: the profile runs from the base to the pole.
Tessellation dome(const std::vector<ProfilePoint>& profile, const std::vector<SinCos>& rim,
                  double sag) {
  const RevolutionSweep sweep{rim, true};
  MeshBuilder builder;
  const auto grid = revolve(builder, sweep, profile.size(), false,
                            [&](std::size_t i, std::size_t) { return profile[i]; });
  builder.polygon(grid[0], true);
  return std::move(builder).take(sag);
}

/// Only the base disc: a surface.
Tessellation disc(double radius, const TessellationTarget& target) {
  const std::vector<SinCos> points =
      rim_of(target, radius, circle_segments(radius, kRimShare * target.sag));
  MeshBuilder builder;
  std::vector<std::uint32_t> ring;
  for (const SinCos& a : points)
    ring.push_back(builder.vertex({radius * a.cos, radius * a.sin, 0}));
  builder.polygon(ring);
  return std::move(builder).take(sag_of_rim(target, radius, points));
}

/// Half an ellipsoid of revolution over its base disc, whose contour runs from rim to rim: it is
/// the image of half a ball, and the contour that of a great circle. The net is that of the degrees
/// whose poles are where that circle meets the rim: both are meridians.
class ContouredDome {
 public:
  /// `rows` from the base to the apex at least; `phase` is the contour's on the rim.
  ContouredDome(double radius, double height, int segments, int rows, const SinCos& phase)
      : radius_(radius), height_(height), rows_(rows), rim_(rim(segments, phase)) {}

  [[nodiscard]] Tessellation make(const Vec3d& towards) && {
    // The ball's own direction: towards the rim away from the poles, and up.
    const Vec3d across{rim_[0].sin, -rim_[0].cos, 0};
    const double out = dot(towards, across) / radius_, up = towards.z / height_;
    const std::vector<double> meridians = divided(arc_tan2(out, -up));
    const std::size_t half = rim_.size() / 2;
    const std::uint32_t first = builder_.vertex(at(0, {0, 1}));
    const std::uint32_t last = builder_.vertex(at(half, {0, 1}));
    std::vector<std::uint32_t> before, base;
    for (const double m : meridians) {
      const SinCos a = sin_cos(m);
      std::vector<std::uint32_t> row{first};
      for (std::size_t k = 1; k < half; ++k) row.push_back(builder_.vertex(at(k, a)));
      row.push_back(last);
      for (std::size_t k = 0; k < half && !before.empty(); ++k)
        builder_.quad(before[k], row[k], row[k + 1], before[k + 1]);
      if (before.empty()) base.assign(row.rbegin(), row.rend() - 1);
      before = std::move(row);
    }
    base.insert(base.end(), before.begin(), before.end() - 1);
    builder_.polygon(base, true);
    const double axis = std::max(radius_, height_);
    const double along = 2 * kPi / static_cast<double>(rim_.size()), step = kPi / (2 * rows_);
    return std::move(builder_).take(axis * (along * along + step * step) / 8);
  }

 private:
  /// Angles of the meridians from one half of the rim to the other, with the contour among them.
  [[nodiscard]] std::vector<double> divided(double contour) const {
    const double step = kPi / (2 * rows_);
    std::vector<double> corners{0, kPi};
    if (contour > step / 4 && kPi - contour > step / 4) corners = {0, contour, kPi};
    std::vector<double> meridians{0};
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const double from = corners[i], span = corners[i + 1] - from;
      const int parts = std::max(1, static_cast<int>(std::ceil(span / step * (1 - 1e-9))));
      for (int k = 1; k <= parts; ++k) meridians.push_back(from + span * k / parts);
    }
    meridians.back() = kPi;
    return meridians;
  }
  /// Point k of a meridian, counted from the pole. The two on the rim take its very points.
  [[nodiscard]] Vec3d at(std::size_t k, const SinCos& meridian) const {
    const std::size_t n = rim_.size();
    const SinCos &left = rim_[k], &right = rim_[(n - k) % n];
    // Half of what they have in common is along the poles, half of what differs across.
    const double x = (left.cos + right.cos) / 2, y = (left.sin + right.sin) / 2;
    const double dx = (right.cos - left.cos) / 2, dy = (right.sin - left.sin) / 2;
    const double up = std::sqrt(dx * dx + dy * dy) * meridian.sin;
    return {radius_ * (x + dx * meridian.cos), radius_ * (y + dy * meridian.cos), height_ * up};
  }

  double radius_, height_;
  int rows_;
  std::vector<SinCos> rim_;
  MeshBuilder builder_;
};

/// Returns the base circle of a dish: that of a pipe, but for one of more than half a ball, which
/// is widest above it.
std::vector<SinCos> rim_of_dish(const SphericalDishPrimitive& p, const TessellationTarget& target,
                                int segments) {
  return p.height > p.radius ? rim(segments, rim_phase(target))
                             : rim_of(target, p.radius, segments);
}

std::optional<Tessellation> cap_in_view(const SphericalDishPrimitive& p,
                                        const TessellationTarget& target, int segments, int rows) {
  if (auto cap = contoured_cap(p, target, segments, rows)) return cap;
  return encircled_cap(p, target, rim_of_dish(p, target, segments), rows);
}

/// An elliptical dish is the image of half a ball under a map that stretches it along its axis, and
/// its silhouette that of the half ball's from the eye's image.
std::optional<Tessellation> elliptical_from_eye(const EllipticalDishPrimitive& p,
                                                const TessellationTarget& target, int segments,
                                                int rows) {
  const double stretch = p.height / p.radius;
  TessellationTarget of_ball = target;
  of_ball.eye->z /= stretch;
  // What is stretched is as much farther from the surface.
  if (stretch > 1)
    segments = static_cast<int>(
        std::min(std::ceil(segments * std::sqrt(stretch)), double{kMaxDomeSegments}));
  auto contoured = cap_in_view(SphericalDishPrimitive{p.radius, p.radius}, of_ball, segments, rows);
  if (!contoured) return std::nullopt;
  for (Vec3d& v : contoured->mesh.vertices) v.z *= stretch;
  contoured->mesh.sag_mm *= std::max(1.0, stretch);
  return contoured;
}

Tessellation turned(Tessellation t, const Basis& b) {
  for (Vec3d& v : t.mesh.vertices) v = b.x * v.x + b.y * v.y + b.z * v.z;
  return t;
}

}  // namespace

Tessellation make(const SpherePrimitive& p, const TessellationTarget& target) {
  if (!are_lengths({p.diameter})) return fault("a length is negative or not finite");
  if (p.diameter == 0) return fault("a sphere of no diameter");
  const double radius = p.diameter / 2;
  const int n = circle_segments(radius, kRimShare * target.sag, kMaxDomeSegments);
  const double rim_sag = sagitta(radius, 2 * kPi / n);
  const int half = arc_segments(radius, kPi / 2, target.sag - rim_sag, kMaxDomeSegments / 4);
  const int rows = 2 * std::max(half, 2);
  const RevolutionSweep sweep{rim(n, {0, 1}), true};
  MeshBuilder builder;
  if (const auto contoured = BallFromEye::of(target, radius)) {
    std::vector<ProfilePoint> profile{{0, -radius}};
    for (const double latitude : contoured->latitudes(radius, rows)) {
      const SinCos a = sin_cos(latitude);
      profile.push_back({radius * a.cos, radius * a.sin});
    }
    profile.push_back({0, radius});
    (void)revolve(builder, sweep, profile.size(), false,
                  [&](std::size_t i, std::size_t) { return profile[i]; });
    return turned(std::move(builder).take(rim_sag + sagitta(radius, kPi / rows)), contoured->basis);
  }
  // From pole to pole; both halves from the same sines.
  (void)revolve(builder, sweep, static_cast<std::size_t>(rows) + 1, false,
                [&](std::size_t i, std::size_t) {
                  const int k = static_cast<int>(i) - rows / 2;
                  const SinCos a = sin_cos(kPi * std::abs(k) / rows);
                  const bool pole = std::abs(k) == rows / 2;
                  return ProfilePoint{pole ? 0 : radius * a.cos,
                                      (k < 0 ? -radius : radius) * (pole ? 1 : a.sin)};
                });
  Tessellation t = std::move(builder).take(rim_sag + sagitta(radius, kPi / rows));
  const Basis b =
      target.towards ? view_basis(target.linear, *target.towards) : world_basis(target.linear);
  return turned(std::move(t), b);
}

Tessellation make(const EllipticalDishPrimitive& p, const TessellationTarget& target) {
  if (!are_lengths({p.radius, p.height})) return fault("a length is negative or not finite");
  if (p.radius == 0) return fault("a dish of no radius");
  if (p.height == 0) return disc(p.radius, target);
  const int n = circle_segments(p.radius, kRimShare * target.sag, kMaxDomeSegments);
  const double rim_sag = sagitta(p.radius, 2 * kPi / n);
  // A chord over the parameter step t strays by at most |second derivative|·t²/8.
  const double axis = std::max(p.radius, p.height), rest = target.sag - rim_sag;
  const double wanted = kPi / 2 * std::sqrt(axis / (8 * rest));
  constexpr int kMaxRows = kMaxDomeSegments / 4;
  const int rows = wanted < kMaxRows ? std::max(2, static_cast<int>(wanted) + 1) : kMaxRows;
  if (const auto& d = target.towards)
    if (const auto phase = contour_phase(d->x, d->y, d->z))
      return ContouredDome(p.radius, p.height, n, rows, *phase).make(*d);
  if (target.eye)
    if (auto contoured = elliptical_from_eye(p, target, n, rows)) return std::move(*contoured);
  std::vector<ProfilePoint> profile;
  for (int k = 0; k < rows; ++k) {
    const SinCos a = sin_cos(kPi / 2 * k / rows);
    profile.push_back({p.radius * a.cos, p.height * a.sin});
  }
  profile.push_back({0, p.height});
  const double step = kPi / 2 / rows;
  const std::vector<SinCos> rim = rim_of(target, p.radius, n);
  return dome(profile, rim, sag_of_rim(target, p.radius, rim) + axis * step * step / 8);
}

Tessellation make(const SphericalDishPrimitive& p, const TessellationTarget& target) {
  if (!are_lengths({p.radius, p.height})) return fault("a length is negative or not finite");
  if (p.radius == 0) return fault("a dish of no radius");
  if (p.height == 0) return disc(p.radius, target);
  const double radius = (p.radius / p.height * p.radius + p.height) / 2;
  const double from_apex = 2 * arc_tan2(p.height, p.radius);
  const double equator = p.height > p.radius ? radius : p.radius;
  const int n = circle_segments(equator, kRimShare * target.sag, kMaxDomeSegments);
  const int rows =
      std::max(2, arc_segments(radius, from_apex, target.sag - sagitta(equator, 2 * kPi / n),
                               kMaxDomeSegments / 2));
  if (target.towards)
    if (auto cap = cap_in_view(p, target, n, rows)) return std::move(*cap);
  // Of more than half a ball, the columns spread, and take more of them to come as near.
  if (target.eye)
    for (int finer = 1; finer <= 4; finer *= 2) {
      auto contoured = cap_in_view(p, target, std::min(n * finer, kMaxDomeSegments),
                                   std::min(rows * finer, kMaxDomeSegments / 2));
      if (!contoured) break;
      if (contoured->mesh.sag_mm <= 1.5 * target.sag || finer == 4) return std::move(*contoured);
    }
  std::vector<ProfilePoint> profile{{p.radius, 0}};
  for (int k = 1; k < rows; ++k) {
    // Depth under the apex without cancellation: radius·(1 - cos) = the sagitta of twice the angle.
    const double angle = from_apex * (rows - k) / rows;
    profile.push_back({radius * sin_cos(angle).sin, p.height - sagitta(radius, 2 * angle)});
  }
  profile.push_back({0, p.height});
  const std::vector<SinCos> rim = rim_of_dish(p, target, n);
  return dome(profile, rim, sag_of_rim(target, equator, rim) + sagitta(radius, from_apex / rows));
}

}  // namespace strake::geometry::tessellation
