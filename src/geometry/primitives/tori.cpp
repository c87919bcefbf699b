// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "geometry/numeric/trig.hpp"
#include "geometry/primitives/mesh_builder.hpp"

namespace strake::geometry::tessellation {
namespace {

constexpr int kMaxTorusSegments = 1024;
constexpr std::string_view kBadAngle = "an angle is not positive or not finite";

/// However small the sweep, a half turn in one step would be flat and a longer one inside out.
int quarter_turns(double angle) {
  return static_cast<int>(std::ceil(angle / (kPi / 2) * (1 - 1e-6)));
}

/// The directions of a sweep from +X. A full one starts where the rule of rims says, so that it
/// does not depend on the local frame.
RevolutionSweep sweep_of(double angle, double radius, double sag, const Mat3d& linear,
                         int least = 1) {
  if (is_full_turn(angle)) {
    const int n = circle_segments(radius, sag, kMaxTorusSegments);
    return {rim(n, canonical_phase(column(linear, 0), column(linear, 1))), true};
  }
  const int n =
      std::max({least, quarter_turns(angle), arc_segments(radius, angle, sag, kMaxTorusSegments)});
  RevolutionSweep sweep;
  for (int k = 0; k <= n; ++k) sweep.directions.push_back(sin_cos(angle * k / n));
  return sweep;
}

double step_of(const RevolutionSweep& sweep, double angle) {
  const auto count = static_cast<double>(sweep.directions.size());
  return sweep.full ? 2 * kPi / count : angle / (count - 1);
}

/// A tube that reaches its axis: the section is the circle's outer part, closed along the axis.
Tessellation clipped(const CircularTorusPrimitive& p, const TessellationTarget& target) {
  const double half = arc_cos(-p.centre_radius / p.tube_radius);
  const int n =
      std::max(4, arc_segments(p.tube_radius, 2 * half, kRimShare * target.sag, kMaxTorusSegments));
  const double rim_sag = sagitta(p.tube_radius, 2 * half / n);
  const double outer = p.centre_radius + p.tube_radius;
  const RevolutionSweep sweep = sweep_of(p.angle, outer, target.sag - rim_sag, target.linear);
  MeshBuilder builder;
  (void)revolve(
      builder, sweep, static_cast<std::size_t>(n) + 1, false, [&](std::size_t i, std::size_t) {
        const int k = static_cast<int>(i);
        const SinCos a = sin_cos(half * (2 * k - n) / n);
        const bool pole = k == 0 || k == n;
        return ProfilePoint{pole ? 0 : std::max(0.0, p.centre_radius + p.tube_radius * a.cos),
                            p.tube_radius * a.sin};
      });
  return std::move(builder).take(rim_sag + sagitta(outer, step_of(sweep, p.angle)));
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

/// A torus whose contour in a view runs along its net: at each section the net starts where the
/// contour of a pipe along it lies, so that the contour is its first and its middle line.
class ContouredTorus {
 public:
  ContouredTorus(const CircularTorusPrimitive& p, const TessellationTarget& target, int segments,
                 double rest)
      : p_{p.centre_radius, p.tube_radius, std::min(p.angle, 2 * kPi)},
        linear_(target.linear),
        towards_(*target.towards),
        segments_(segments),
        full_(is_full_turn(p.angle)),
        in_plane_(std::sqrt(towards_.x * towards_.x + towards_.y * towards_.y)) {
    const double outer = p.centre_radius + p.tube_radius;
    sweep_step_ = p_.angle / std::max({1, quarter_turns(p_.angle),
                                       arc_segments(outer, p_.angle, rest, kMaxTorusSegments)});
  }

  [[nodiscard]] Tessellation make() {
    choose_sections();
    const std::vector<SinCos> circle = unit_circle(segments_);
    std::vector<SinCos> starts;
    for (const Section& s : sections_) starts.push_back(sin_cos(s.start));
    RevolutionSweep sweep{{}, full_};
    for (const Section& s : sections_) sweep.directions.push_back(sin_cos(s.angle));
    MeshBuilder builder(towards_);
    (void)revolve(builder, sweep, circle.size(), true, [&](std::size_t i, std::size_t j) {
      const SinCos &c = circle[i], &s = starts[j];
      return ProfilePoint{p_.centre_radius + p_.tube_radius * (c.cos * s.cos - c.sin * s.sin),
                          p_.tube_radius * (c.sin * s.cos + c.cos * s.sin)};
    });
    return std::move(builder).take(sag());
  }

 private:
  struct Section {
    double angle = 0;  ///< of the sweep
    double start = 0;  ///< in the section, from its outer side
  };

  [[nodiscard]] double step() const { return 2 * kPi / segments_; }

  /// Seen in its plane, to an eighth of a step: the contour is the highest and the lowest line, and
  /// wholly the sections that are seen edge-on.
  [[nodiscard]] bool in_elevation() const { return std::fabs(towards_.z) < step() / 8 * in_plane_; }

  /// Where the contour lies in a section; of the two the one that goes on without a jump.
  [[nodiscard]] double contour(double angle) const {
    if (in_elevation()) return kPi / 2;
    const SinCos a = sin_cos(angle);
    const double out = towards_.x * a.cos + towards_.y * a.sin;
    return arc_tan2(towards_.z > 0 ? -out : out, std::fabs(towards_.z));
  }

  /// Where the rim of a pipe along the section starts, as near as steps allow to the contour here.
  [[nodiscard]] double at_end(double angle) const {
    const SinCos a = sin_cos(angle);
    const double out = towards_.x * a.cos + towards_.y * a.sin;
    const double along = towards_.y * a.cos - towards_.x * a.sin;
    const Vec3d radial = column(linear_, 0) * a.cos + column(linear_, 1) * a.sin;
    const SinCos phase =
        contour_phase(out, towards_.z, along).value_or(canonical_phase(radial, column(linear_, 2)));
    const double here = contour(angle);
    const double steps = (arc_tan2(phase.sin, phase.cos) - here) / step();
    const double twist = (steps - std::floor(steps + 0.5)) * step();
    // What rounding left of agreement is no twist.
    return here + (std::fabs(twist) < 1e-6 * step() ? 0 : twist);
  }

  void choose_sections() {
    std::vector<double> corners{0};
    if (in_elevation()) {
      const double edge_on = arc_tan2(-towards_.x, towards_.y);
      for (double a = edge_on - 2 * kPi; a < p_.angle; a += kPi)
        if (a > corners.back() + sweep_step_ / 4 && a < p_.angle - sweep_step_ / 4)
          corners.push_back(a);
    }
    corners.push_back(p_.angle);
    sections_.push_back({0, full_ ? contour(0) : at_end(0)});
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const double from = corners[i], span = corners[i + 1] - from;
      const int parts = std::max(1, static_cast<int>(std::ceil(span / sweep_step_ * (1 - 1e-9))));
      for (int k = 1; k <= parts; ++k) {
        const double angle = k == parts ? corners[i + 1] : from + span * k / parts;
        add(angle, 0);
      }
    }
    if (full_)
      sections_.pop_back();
    else
      sections_.back().start = at_end(p_.angle);
  }

  /// A section, and before it such that the contour turns by half a step at most from one to the
  /// next.
  void add(double angle, int depth) {
    constexpr int kDeepest = 12;
    const Section before = sections_.back();
    const double here = contour(angle);
    const double middle = (before.angle + angle) / 2, between = contour(middle);
    const double turn =
        std::max(std::fabs(here - between), std::fabs(between - contour(before.angle)));
    if (turn > step() / 4 && depth < kDeepest) {
      add(middle, depth + 1);
      add(angle, depth + 1);
      return;
    }
    sections_.push_back({angle, here});
  }

  /// A triangle strays from the surface by at most a sixth of the largest of its edges'
  /// |second derivative|·(step)², where the mixed one is that of the tube alone.
  [[nodiscard]] double sag() const {
    double largest = 0;
    const auto count = sections_.size();
    for (std::size_t j = 0; j + (full_ ? 0 : 1) < count; ++j) {
      const Section &a = sections_[j], &b = sections_[j + 1 == count ? 0 : j + 1];
      const double turned = b.angle - a.angle;
      const double along = turned < 0 ? turned + p_.angle : turned;
      const double across = step() + std::fabs(b.start - a.start);
      const double outer = p_.centre_radius + p_.tube_radius;
      largest =
          std::max(largest, outer * along * along + p_.tube_radius * across * (2 * along + across));
    }
    return largest / 6;
  }

  const CircularTorusPrimitive p_;  ///< which turns once at most
  const Mat3d& linear_;
  Vec3d towards_;
  int segments_;
  bool full_;
  double in_plane_;
  double sweep_step_ = 0;
  std::vector<Section> sections_;
};

}  // namespace

Tessellation make(const CircularTorusPrimitive& p, const TessellationTarget& target) {
  if (!are_lengths({p.centre_radius, p.tube_radius}))
    return fault("a length is negative or not finite");
  if (!(p.angle > 0) || !std::isfinite(p.angle)) return fault(kBadAngle);
  if (p.tube_radius == 0) return fault("a torus of no thickness");
  if (p.tube_radius >= p.centre_radius) return clipped(p, target);
  const int n = circle_segments(p.tube_radius, kRimShare * target.sag, kMaxTorusSegments);
  const double rim_sag = sagitta(p.tube_radius, 2 * kPi / n);
  if (target.eye)
    if (auto contoured = torus_from_eye(p, target, n, target.sag - rim_sag))
      return std::move(*contoured);
  if (target.towards) return ContouredTorus(p, target, n, target.sag - rim_sag).make();
  const bool full = is_full_turn(p.angle);
  const EndPhases phases = full ? EndPhases{} : end_phases(p, target.linear, n);
  const double outer = p.centre_radius + p.tube_radius, rest = target.sag - rim_sag;
  RevolutionSweep sweep = sweep_of(p.angle, outer, rest, target.linear);
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
    while (bound(steps) > rest && steps < kMaxTorusSegments) ++steps;
    sweep = sweep_of(p.angle, outer, rest, target.linear, steps);
    sweep_sag = bound(static_cast<int>(sweep.directions.size()) - 1);
  }
  const std::vector<SinCos> circle = unit_circle(n);
  const auto steps = static_cast<double>(sweep.directions.size() - 1);
  std::vector<SinCos> starts;
  for (std::size_t j = 0; j < sweep.directions.size(); ++j)
    starts.push_back(sin_cos(phases.first + phases.twist * static_cast<double>(j) / steps));
  MeshBuilder builder;
  (void)revolve(builder, sweep, circle.size(), true, [&](std::size_t i, std::size_t j) {
    const SinCos &c = circle[i], &s = starts[j];
    return ProfilePoint{p.centre_radius + p.tube_radius * (c.cos * s.cos - c.sin * s.sin),
                        p.tube_radius * (c.sin * s.cos + c.cos * s.sin)};
  });
  return std::move(builder).take(rim_sag + sweep_sag);
}

Tessellation make(const RectangularTorusPrimitive& p, const TessellationTarget& target) {
  if (!are_lengths({p.inner_radius, p.outer_radius, p.height}))
    return fault("a length is negative or not finite");
  if (!(p.angle > 0) || !std::isfinite(p.angle)) return fault(kBadAngle);
  if (p.outer_radius == 0) return fault("a torus of no radius");
  if (p.inner_radius > p.outer_radius) return fault("the inner radius is the larger one");
  const RevolutionSweep sweep =
      sweep_of(p.angle, p.outer_radius, kRimShare * target.sag, target.linear);
  const double half = p.height / 2;
  const std::array<ProfilePoint, 4> corners{{{p.inner_radius, -half},
                                             {p.outer_radius, -half},
                                             {p.outer_radius, half},
                                             {p.inner_radius, half}}};
  MeshBuilder builder;
  (void)revolve(builder, sweep, corners.size(), true,
                [&](std::size_t i, std::size_t) { return corners[i]; });
  return std::move(builder).take(sagitta(p.outer_radius, step_of(sweep, p.angle)));
}

}  // namespace strake::geometry::tessellation
