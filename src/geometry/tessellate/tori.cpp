// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "geometry/full_turn.hpp"
#include "geometry/tessellate/revolve.hpp"

namespace strake::geometry::tessellation {
namespace {

constexpr int kMostSegments = 1024;
constexpr std::string_view kBadAngle = "an angle is not positive or not finite";

/// However small the sweep, a half turn in one step would be flat and a longer one inside out.
int quarter_turns(double angle) {
  return static_cast<int>(std::ceil(angle / (kPi / 2) * (1 - 1e-6)));
}

/// The directions of a sweep from +X. A full one starts where the rule of rims says, so that it
/// does not depend on the local frame.
Sweep sweep_of(double angle, double radius, double sag, const Mat3d& linear, int least = 1) {
  if (is_full_turn(angle)) {
    const int n = circle_segments(radius, sag, kMostSegments);
    return {rim(n, canonical_phase(column(linear, 0), column(linear, 1))), true};
  }
  const int n =
      std::max({least, quarter_turns(angle), arc_segments(radius, angle, sag, kMostSegments)});
  Sweep sweep;
  for (int k = 0; k <= n; ++k) sweep.directions.push_back(sin_cos(angle * k / n));
  return sweep;
}

double step_of(const Sweep& sweep, double angle) {
  const auto count = static_cast<double>(sweep.directions.size());
  return sweep.full ? 2 * kPi / count : angle / (count - 1);
}

/// A tube that reaches its axis: the section is the circle's outer part, closed along the axis.
Tessellation clipped(const CircularTorusPrimitive& p, const Target& target) {
  const double half = arc_cos(-p.centre_radius / p.tube_radius);
  const int n =
      std::max(4, arc_segments(p.tube_radius, 2 * half, kRimShare * target.sag, kMostSegments));
  const double rim_sag = sagitta(p.tube_radius, 2 * half / n);
  const double outer = p.centre_radius + p.tube_radius;
  const Sweep sweep = sweep_of(p.angle, outer, target.sag - rim_sag, target.linear);
  Builder builder;
  (void)revolve(
      builder, sweep, static_cast<std::size_t>(n) + 1, false, [&](std::size_t i, std::size_t) {
        const int k = static_cast<int>(i);
        const SinCos a = sin_cos(half * (2 * k - n) / n);
        const bool pole = k == 0 || k == n;
        return ProfilePoint{pole ? 0 : std::max(0.0, p.centre_radius + p.tube_radius * a.cos),
                            p.tube_radius * a.sin};
      });
  return std::move(builder).take(rim_sag + sagitta(outer, step_of(sweep, p.angle)), false);
}

/// Where the section's vertices start at both ends of an elbow, as angles in the section.
struct EndPhases {
  double first = 0;
  double twist = 0;  ///< to the nearest vertex of the other end's rim: at most half a step
};

EndPhases end_phases(const CircularTorusPrimitive& p, const Mat3d& linear, int segments) {
  const Vec3d axis = column(linear, 2);
  const SinCos end = sin_cos(p.angle);
  const SinCos a = canonical_phase(column(linear, 0), axis);
  const SinCos b = canonical_phase(column(linear, 0) * end.cos + column(linear, 1) * end.sin, axis);
  const double step = 2 * kPi / segments;
  EndPhases phases{arc_tan2(a.sin, a.cos), 0};
  const double turn = (arc_tan2(b.sin, b.cos) - phases.first) / step;
  phases.twist = (turn - std::floor(turn + 0.5)) * step;
  // What rounding left of agreement is no twist.
  if (std::fabs(phases.twist) < 1e-6 * step) phases.twist = 0;
  return phases;
}

/// Bound on the chords along a sweep of the given step when sections turn by `turn` a radian:
/// |second derivative along the sweep|·step²/8, twice over for the fold of the quads' diagonals.
double twisted_sag(const CircularTorusPrimitive& p, double step, double turn) {
  const double r = p.tube_radius;
  const double along = p.centre_radius + r + 2 * turn * r + turn * turn * r;
  return along * step * step / 8;
}

}  // namespace

Tessellation make(const CircularTorusPrimitive& p, const Target& target) {
  if (!are_lengths({p.centre_radius, p.tube_radius}))
    return fault("a length is negative or not finite");
  if (!(p.angle > 0) || !std::isfinite(p.angle)) return fault(kBadAngle);
  if (p.tube_radius == 0) return fault("a torus of no thickness");
  if (p.tube_radius >= p.centre_radius) return clipped(p, target);
  const int n = circle_segments(p.tube_radius, kRimShare * target.sag, kMostSegments);
  const double rim_sag = sagitta(p.tube_radius, 2 * kPi / n);
  const bool full = is_full_turn(p.angle);
  const EndPhases phases = full ? EndPhases{} : end_phases(p, target.linear, n);
  const double outer = p.centre_radius + p.tube_radius, rest = target.sag - rim_sag;
  Sweep sweep = sweep_of(p.angle, outer, rest, target.linear);
  double sweep_sag = sagitta(outer, step_of(sweep, p.angle));
  if (phases.twist != 0) {
    // Twisted quads are not planar: their diagonals fold by at most the cross term.
    const double turn = std::fabs(phases.twist) / p.angle;
    const double chord = 2 * kPi / n;
    int steps = static_cast<int>(sweep.directions.size()) - 1;
    const auto bound = [&](int count) {
      const double step = p.angle / count;
      return twisted_sag(p, step, turn) + turn * step * chord * p.tube_radius / 4;
    };
    while (bound(steps) > rest && steps < kMostSegments) ++steps;
    sweep = sweep_of(p.angle, outer, rest, target.linear, steps);
    sweep_sag = bound(static_cast<int>(sweep.directions.size()) - 1);
  }
  const std::vector<SinCos> circle = unit_circle(n);
  const auto steps = static_cast<double>(sweep.directions.size() - 1);
  std::vector<SinCos> starts;
  for (std::size_t j = 0; j < sweep.directions.size(); ++j)
    starts.push_back(sin_cos(phases.first + phases.twist * static_cast<double>(j) / steps));
  Builder builder;
  (void)revolve(builder, sweep, circle.size(), true, [&](std::size_t i, std::size_t j) {
    const SinCos &c = circle[i], &s = starts[j];
    return ProfilePoint{p.centre_radius + p.tube_radius * (c.cos * s.cos - c.sin * s.sin),
                        p.tube_radius * (c.sin * s.cos + c.cos * s.sin)};
  });
  return std::move(builder).take(rim_sag + sweep_sag, false);
}

Tessellation make(const RectangularTorusPrimitive& p, const Target& target) {
  if (!are_lengths({p.inner_radius, p.outer_radius, p.height}))
    return fault("a length is negative or not finite");
  if (!(p.angle > 0) || !std::isfinite(p.angle)) return fault(kBadAngle);
  if (p.outer_radius == 0) return fault("a torus of no radius");
  if (p.inner_radius > p.outer_radius) return fault("the inner radius is the larger one");
  const Sweep sweep = sweep_of(p.angle, p.outer_radius, kRimShare * target.sag, target.linear);
  const double half = p.height / 2;
  const std::array<ProfilePoint, 4> corners{{{p.inner_radius, -half},
                                             {p.outer_radius, -half},
                                             {p.outer_radius, half},
                                             {p.inner_radius, half}}};
  Builder builder;
  (void)revolve(builder, sweep, corners.size(), true,
                [&](std::size_t i, std::size_t) { return corners[i]; });
  const bool convex = p.inner_radius == 0 && (is_full_turn(p.angle) || p.angle <= kPi);
  return std::move(builder).take(sagitta(p.outer_radius, step_of(sweep, p.angle)), convex);
}

}  // namespace strake::geometry::tessellation
