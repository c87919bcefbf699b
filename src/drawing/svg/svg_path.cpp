// SPDX-License-Identifier: Apache-2.0
#include "drawing/svg/svg_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/number.hpp"
#include "geometry/numeric/trig.hpp"

namespace strake::drawing {

namespace {

using geometry::kPi;

/// The longest arc, since an SVG arc is given by its ends, which hardly determine it at half a
/// turn.
constexpr double kLongestArc = 0.7 * kPi;

void append_point(std::string& out, const PaperPoint& p) {
  out += shortest(p.x);
  out += ' ';
  out += shortest(p.y);
}

double rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

void append_arc(std::string& out, const EllipseAxes& axes, bool sweep, const PaperPoint& end) {
  out += 'A';
  out += shortest(rounded(axes.major, 1000));
  out += ' ';
  out += shortest(rounded(axes.minor, 1000));
  out += ' ';
  out += shortest(rounded(axes.turn_rad * 180 / kPi, 1000) + 0.0);
  out += sweep ? " 0 1 " : " 0 0 ";
  append_point(out, end);
}

/// Appends the arcs of a run, none of them longer than kLongestArc.
void append_arcs(std::string& out, const Stroke& stroke, const StrokeRun& run) {
  const EllipseAxes axes = axes_of(*run.curve);
  const bool sweep = run.forward != is_left_handed(*run.curve);
  double turned = 0;
  for (std::size_t i = run.first; i < run.last; ++i) {
    const double turn = std::fabs(turn_between(*run.curve, stroke.points[i], stroke.points[i + 1]));
    if (turned > 0 && turned + turn > kLongestArc) {
      append_arc(out, axes, sweep, stroke.points[i]);
      turned = 0;
    }
    turned += turn;
  }
  append_arc(out, axes, sweep, stroke.points[run.last]);
}

}  // namespace

void append_svg_chain(std::string& out, const Chain& chain) {
  const bool closed = chain.size() > 3 && chain.front() == chain.back();
  out += 'M';
  append_point(out, chain.front());
  for (std::size_t i = 1; i + (closed ? 1 : 0) < chain.size(); ++i) {
    out += i == 1 ? 'L' : ' ';
    append_point(out, chain[i]);
  }
  if (closed) out += 'Z';
}

void append_svg_path(std::string& out, const Stroke& stroke) {
  if (std::ranges::all_of(stroke.runs, [](const auto& run) { return run.curve == nullptr; }))
    return append_svg_chain(out, stroke.points);
  out += 'M';
  append_point(out, stroke.points.front());
  for (const StrokeRun& run : stroke.runs) {
    if (run.curve != nullptr) {
      append_arcs(out, stroke, run);
      continue;
    }
    for (std::size_t i = run.first + 1; i <= run.last; ++i) {
      out += i == run.first + 1 ? 'L' : ' ';
      append_point(out, stroke.points[i]);
    }
  }
  if (stroke.closed()) out += 'Z';
}

}  // namespace strake::drawing
