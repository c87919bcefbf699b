// SPDX-License-Identifier: Apache-2.0
#include "drawing/strokes/strokes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/numeric/trig.hpp"

namespace strake::drawing {

namespace {

using geometry::kPi;

/// Returns whether an ellipse is drawn as straight lines: seen nearly edge-on it is narrower than a
/// pen, and viewers of SVG leave gaps in elliptical arcs as flat as that.
bool is_straight(const PaperCurve& curve) {
  constexpr double kNoWidth = 0.01, kNarrow = 0.1;  // half the minor axis, mm
  constexpr double kFlat = 4;                       // times as long as wide
  const EllipseAxes axes = axes_of(curve);
  return axes.minor < kNoWidth || (axes.minor < kNarrow && axes.minor * kFlat < axes.major);
}

/// Returns the point of the curve halfway between two of its points; none for opposite ones.
std::optional<PaperPoint> halfway(const PaperCurve& c, const PaperPoint& a, const PaperPoint& b) {
  const double area = c.u.x * c.v.y - c.u.y * c.v.x;
  const double x = a.x + b.x - 2 * c.centre.x, y = a.y + b.y - 2 * c.centre.y;
  const double s = (x * c.v.y - y * c.v.x) / area, t = (c.u.x * y - c.u.y * x) / area;
  const double length = std::sqrt(s * s + t * t);
  if (!(length > 1e-6)) return std::nullopt;
  return PaperPoint{c.centre.x + (c.u.x * s + c.v.x * t) / length,
                    c.centre.y + (c.u.y * s + c.v.y * t) / length};
}

class StrokeFinder {
 public:
  StrokeFinder(const JoinedLines& chain, const PaperCurves& curves) {
    stroke_.points = chain.points;
    for (const Line* line : chain.lines) {
      const PaperCurve* curve = curves.of(*line);
      of_.push_back(curve != nullptr && !is_straight(*curve) ? curve : nullptr);
    }
  }

  Stroke find() {
    turn_to_a_change();
    for (std::size_t i = 0; i < of_.size(); i = stroke_.runs.back().last)
      stroke_.runs.push_back(of_[i] == nullptr ? straight(i) : arc(i));
    return std::move(stroke_);
  }

 private:
  /// Rotates a closed chain to begin where one curve ends and another begins.
  void turn_to_a_change() {
    Chain& points = stroke_.points;
    if (points.size() < 3 || !(points.front() == points.back())) return;
    std::size_t at = 0;
    while (at < of_.size() && of_[at] == of_.back()) ++at;
    if (at == 0 || at == of_.size()) return;
    points.pop_back();
    std::ranges::rotate(points, points.begin() + static_cast<std::ptrdiff_t>(at));
    std::ranges::rotate(of_, of_.begin() + static_cast<std::ptrdiff_t>(at));
    points.push_back(points.front());
  }

  [[nodiscard]] StrokeRun straight(std::size_t first) const {
    std::size_t end = first;
    while (end < of_.size() && of_[end] == nullptr) ++end;
    return {nullptr, true, first, end};
  }

  [[nodiscard]] StrokeRun arc(std::size_t first) const {
    const PaperCurve& curve = *of_[first];
    const Chain& points = stroke_.points;
    const bool forward = turn_between(curve, points[first], points[first + 1]) > 0;
    std::size_t end = first + 1;
    while (end < of_.size() && of_[end] == &curve &&
           (turn_between(curve, points[end], points[end + 1]) > 0) == forward)
      ++end;
    return {&curve, forward, first, end};
  }

  Stroke stroke_;
  std::vector<const PaperCurve*> of_;
};

}  // namespace

Stroke stroke_of(const JoinedLines& chain, const PaperCurves& curves) {
  return StrokeFinder(chain, curves).find();
}

EllipseAxes axes_of(const PaperCurve& c) {
  // The matrix u·uᵀ + v·vᵀ has the squares of the half axes as eigenvalues.
  const double a = c.u.x * c.u.x + c.v.x * c.v.x, b = c.u.x * c.u.y + c.v.x * c.v.y,
               d = c.u.y * c.u.y + c.v.y * c.v.y;
  const double middle = (a + d) / 2, half = (a - d) / 2, off = std::sqrt(half * half + b * b);
  const double major = std::sqrt(middle + off);
  const double area = std::fabs(c.u.x * c.v.y - c.u.y * c.v.x);
  const bool round = off <= 1e-9 * middle;
  return {major, major > 0 ? area / major : 0, round ? 0 : geometry::arc_tan2(b, half) / 2};
}

bool is_left_handed(const PaperCurve& c) { return c.u.x * c.v.y < c.u.y * c.v.x; }

double curve_parameter(const PaperCurve& c, const PaperPoint& p) {
  const double x = p.x - c.centre.x, y = p.y - c.centre.y;
  const double area = c.u.x * c.v.y - c.u.y * c.v.x;
  return geometry::arc_tan2((c.u.x * y - c.u.y * x) / area, (x * c.v.y - y * c.v.x) / area);
}

double turn_between(const PaperCurve& c, const PaperPoint& from, const PaperPoint& to) {
  const double turn = curve_parameter(c, to) - curve_parameter(c, from);
  return turn > kPi ? turn - 2 * kPi : turn <= -kPi ? turn + 2 * kPi : turn;
}

double length_along(const PaperCurve* curve, const PaperPoint& a, const PaperPoint& b) {
  const double chord = distance(a, b);
  const auto middle = curve != nullptr ? halfway(*curve, a, b) : std::nullopt;
  // Richardson's step from one chord to two leaves an error of the fourth order.
  return middle ? (4 * (distance(a, *middle) + distance(*middle, b)) - chord) / 3 : chord;
}

double turn_of(const Stroke& stroke, const StrokeRun& arc) {
  double turn = 0;
  for (std::size_t i = arc.first; i < arc.last; ++i)
    turn += turn_between(*arc.curve, stroke.points[i], stroke.points[i + 1]);
  return turn;
}

}  // namespace strake::drawing
