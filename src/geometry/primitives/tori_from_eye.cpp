// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/numeric/trig.hpp"
#include "geometry/primitives/mesh_builder.hpp"

namespace strake::geometry::tessellation {
namespace {

constexpr int kMaxSteps = 1024;
/// How far a line of the contour may turn in its section where the section turns by one about the
/// axis. Where it turns faster, as of a bend that is seen from low over its plane, the triangles
/// beside it are slivers across it, which hide it in places.
constexpr double kSteepest = 6;

/// A torus whose contour from an eye runs along its net. In the plane of a section the normals are
/// those of its circle, so that its contour is that of a pipe along it: where the tangents from the
/// eye's image in that plane touch. Between these the section has half of its chords on either
/// side, as the rim of a pipe at its end.
class TorusFromEye {
 public:
  TorusFromEye(const CircularTorusPrimitive& p, const Vec3d& eye, int segments)
      : p_{p.centre_radius, p.tube_radius, std::min(p.angle, 2 * kPi)},
        eye_(eye),
        segments_(segments),
        full_(is_full_turn(p.angle)) {}

  [[nodiscard]] std::optional<Tessellation> make(double rest) {
    const double outer = p_.centre_radius + p_.tube_radius;
    const int quarters = static_cast<int>(std::ceil(p_.angle / (kPi / 2) * (1 - 1e-6)));
    const int steps = std::max({1, quarters, arc_segments(outer, p_.angle, rest, kMaxSteps)});
    if (!add(0)) return std::nullopt;
    for (int k = 1; k <= steps; ++k)
      if (!add_from_last(p_.angle * k / steps, 0)) return std::nullopt;
    if (full_) sections_.pop_back();
    RevolutionSweep sweep{{}, full_};
    for (const Section& s : sections_) sweep.directions.push_back(sin_cos(s.angle));
    MeshBuilder builder(std::nullopt, eye_);
    (void)revolve(
        builder, sweep, static_cast<std::size_t>(segments_), true,
        [&](std::size_t i, std::size_t j) {
          const SinCos a = point_between(sections_[j].contour, segments_, static_cast<int>(i));
          return ProfilePoint{p_.centre_radius + p_.tube_radius * a.cos, p_.tube_radius * a.sin};
        });
    return std::move(builder).take(sag());
  }

 private:
  struct Section {
    double angle = 0;  ///< of the sweep
    EyeContour contour;
  };

  [[nodiscard]] double step() const { return 2 * kPi / segments_; }

  /// Returns the contour in a section; none where the eye is in its circle or near it.
  [[nodiscard]] std::optional<EyeContour> contour(double angle) const {
    const SinCos a = sin_cos(angle);
    const double out = eye_.x * a.cos + eye_.y * a.sin - p_.centre_radius;
    if (!is_far(out, eye_.z, p_.tube_radius)) return std::nullopt;
    return EyeContour::of(out, eye_.z, p_.tube_radius);
  }

  /// Returns how far either line of the contour turns between two sections, at most.
  [[nodiscard]] static double turn(const EyeContour& from, const EyeContour& to) {
    const auto between = [](double a, double b) {
      const double apart = std::fabs(std::fmod(b - a, 2 * kPi));
      return std::min(apart, 2 * kPi - apart);
    };
    return std::max(between(from.first, to.first), between(from.second, to.second));
  }

  [[nodiscard]] bool add(double angle) {
    const auto here = contour(angle);
    if (here) sections_.push_back({angle, *here});
    return here.has_value();
  }

  /// Adds a section, and before it such that the contour turns by half a step at most from one to
  /// the next. Returns whether all have one.
  [[nodiscard]] bool add_from_last(double angle, int depth) {
    constexpr int kDeepest = 12;
    const Section before = sections_.back();
    const double middle = (before.angle + angle) / 2;
    const auto here = contour(angle), between = contour(middle);
    if (!here || !between) return false;
    const double maximum = std::max(turn(*between, *here), turn(before.contour, *between));
    if (maximum > kSteepest * (angle - middle)) return false;
    if (maximum > step() / 4 && depth < kDeepest)
      return add_from_last(middle, depth + 1) && add_from_last(angle, depth + 1);
    sections_.push_back({angle, *here});
    return true;
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
      const double chord = 2 * std::max(a.contour.far_side(), b.contour.far_side()) / segments_;
      const double across = chord + turn(a.contour, b.contour);
      const double outer = p_.centre_radius + p_.tube_radius;
      largest =
          std::max(largest, outer * along * along + p_.tube_radius * across * (2 * along + across));
    }
    return largest / 6;
  }

  const CircularTorusPrimitive p_;  ///< which turns once at most
  Vec3d eye_;
  int segments_;
  bool full_;
  std::vector<Section> sections_;
};

}  // namespace

std::optional<Tessellation> torus_from_eye(const CircularTorusPrimitive& p,
                                           const TessellationTarget& target, int segments,
                                           double rest) {
  return TorusFromEye(p, *target.eye, segments).make(rest);
}

}  // namespace strake::geometry::tessellation
