// SPDX-License-Identifier: Apache-2.0
#include "drawing/pdf/pdf_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "drawing/pdf/pdf_syntax.hpp"
#include "geometry/numeric/trig.hpp"

namespace strake::drawing {

namespace {

using geometry::kPi;

/// Returns the number of cubic curves for an arc. One for a quarter of a circle is 2.7e-4 radii off
/// at most, and the error falls with the sixth power of the angle. A thousand are enough for any
/// circle that can be drawn; what is larger, as templates may have it, or no number, has no more.
int curves_of(const PaperCurve& curve, double turn) {
  constexpr double kErrorOfQuarter = 2.73e-4;
  constexpr int kMax = 1000;
  const double radius = axes_of(curve).major;
  int n = std::max(1, static_cast<int>(std::ceil(std::fabs(turn) / (kPi / 2) - 1e-9)));
  for (;; ++n) {
    const double quarters = std::fabs(turn) / n / (kPi / 2);
    const double cube = quarters * quarters * quarters;
    if (n >= kMax || radius * kErrorOfQuarter * cube * cube <= kPdfCurveErrorMm) return n;
  }
}

PaperPoint point_at(const PaperCurve& c, const geometry::SinCos& t) {
  return {c.centre.x + c.u.x * t.cos + c.v.x * t.sin, c.centre.y + c.u.y * t.cos + c.v.y * t.sin};
}

/// Returns the derivative by the parameter.
PaperPoint slope_at(const PaperCurve& c, const geometry::SinCos& t) {
  return {c.v.x * t.cos - c.u.x * t.sin, c.v.y * t.cos - c.u.y * t.sin};
}

}  // namespace

void append_pdf_chain(std::string& out, const Chain& chain) {
  const bool closed = chain.size() > 3 && chain.front() == chain.back();
  append_pdf_point(out, chain.front());
  out += "m\n";
  for (std::size_t i = 1; i + (closed ? 1 : 0) < chain.size(); ++i) {
    append_pdf_point(out, chain[i]);
    out += "l\n";
  }
  if (closed) out += "h\n";
}

void append_pdf_arc(std::string& out, const PaperCurve& curve, double from, double turn,
                    const PaperPoint& end) {
  const int n = curves_of(curve, turn);
  const double step = turn / n;
  const geometry::SinCos quarter = geometry::sin_cos(step / 4);
  const double reach = 4.0 / 3 * quarter.sin / quarter.cos;
  geometry::SinCos at = geometry::sin_cos(from);
  for (int i = 1; i <= n; ++i) {
    const geometry::SinCos next = geometry::sin_cos(from + step * i);
    const PaperPoint first = point_at(curve, at), last = point_at(curve, next);
    const PaperPoint out_of = slope_at(curve, at), into = slope_at(curve, next);
    append_pdf_point(out, {first.x + reach * out_of.x, first.y + reach * out_of.y});
    append_pdf_point(out, {last.x - reach * into.x, last.y - reach * into.y});
    append_pdf_point(out, i == n ? end : last);
    out += "c\n";
    at = next;
  }
}

void append_pdf_stroke(std::string& out, const Stroke& stroke) {
  append_pdf_point(out, stroke.points.front());
  out += "m\n";
  const bool closed = stroke.closed();
  for (const StrokeRun& run : stroke.runs) {
    if (run.curve != nullptr) {
      append_pdf_arc(out, *run.curve, curve_parameter(*run.curve, stroke.points[run.first]),
                     turn_of(stroke, run), stroke.points[run.last]);
      continue;
    }
    for (std::size_t i = run.first + 1; i <= run.last; ++i) {
      if (closed && i + 1 == stroke.points.size()) break;  // closing draws it
      append_pdf_point(out, stroke.points[i]);
      out += "l\n";
    }
  }
  if (closed) out += "h\n";
}

void append_pdf_circle(std::string& out, const PaperPoint& center, double radius_mm) {
  const PaperPoint right{center.x + radius_mm, center.y};
  append_pdf_point(out, right);
  out += "m\n";
  append_pdf_arc(out, {center, {radius_mm, 0}, {0, radius_mm}}, 0, 2 * kPi, right);
  out += "h\n";
}

}  // namespace strake::drawing
