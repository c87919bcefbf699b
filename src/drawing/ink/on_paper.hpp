// SPDX-License-Identifier: Apache-2.0
// Lines as ink meets them: their places without rounding, and their widths.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "drawing/collinear/collinear_overlaps.hpp"
#include "drawing/layout/view_plane.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/drawing/object_styles.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/reduce.hpp"

namespace strake::drawing {

/// Returns by how much distances on paper may differ that are meant to be equal, mm. Corners are
/// rounded to the grid: two of them may be two steps farther apart than meant, or nearer. With half
/// a step more, a limit is a distance that corners seldom have.
[[nodiscard]] inline double corner_rounding_mm(double scale) {
  return 4.5 * geometry::kMmPerGrid / scale;
}

/// Returns the width of a line as it is of objects without a style.
[[nodiscard]] inline double usual_width(const Line& line, const Pens& pens) {
  if (line.state != LineState::visible || line.kind == hlr::EdgeKind::polyline ||
      line.kind == hlr::EdgeKind::hatch || line.kind == hlr::EdgeKind::smooth)
    return pens.thin;
  if (line.kind == hlr::EdgeKind::section) return pens.section;
  return line.kind == hlr::EdgeKind::contour || line.kind == hlr::EdgeKind::single_line
             ? pens.outline
             : pens.edge;
}

[[nodiscard]] inline double width_of(const Line& line, const Ink& ink) {
  const double width = usual_width(line, ink.pens);
  if (ink.styles == nullptr) return width;
  return width * ink.styles->widening(ink.styles->number_of(line), ink.pens.edge);
}

/// The places of lines on paper, without rounding, which would make equal objects unequal where
/// their ink nearly touches.
class OnPaper {
 public:
  /// The axes must outlive the result. Errors: cancelled, out of memory.
  [[nodiscard]] static Result<OnPaper> of(const std::vector<Line>& lines, const PaperAxes& axes,
                                          double scale, const parallel::Context& context) {
    OnPaper made(axes, scale);
    if (lines.empty()) return made;
    // An origin near the lines that does not depend on their order.
    const auto lowest = [](geometry::Vec3d& into, const geometry::Vec3d& p) {
      into = {std::min(into.x, p.x), std::min(into.y, p.y), std::min(into.z, p.z)};
    };
    constexpr std::size_t kGrain = 16384;
    const auto origin = parallel::reduce(
        context, {.name = "origin of lines", .n = lines.size(), .grain = kGrain},
        lines.front().a_mm,
        [&](geometry::Vec3d& least, std::size_t i) { lowest(least, lines[i].a_mm); }, lowest);
    if (!origin) return origin.error();
    made.origin_ = *origin;
    return made;
  }

  [[nodiscard]] PlaneSegment operator()(const Line& line) const {
    const PaperPoint a = at(line.a_mm, line.a_paper), b = at(line.b_mm, line.b_paper);
    return {.ax = a.x, .ay = a.y, .bx = b.x, .by = b.y};
  }

  /// Returns the order in which hidden lines of an object are laid down: the nearer first, and of
  /// equally near ones the left and upper one. It is one number, a depth along a direction that
  /// leans off the view a little, as hardly any two edges do to each other: with depths alone, a
  /// corner's rounding to the grid would choose between the edges of a face that is seen square.
  [[nodiscard]] double order(const Line& line, const PlaneSegment& flat) const {
    constexpr double kLeft = 0.13, kUp = 0.08;
    const double toward = dot(axes_.toward, (line.a_mm - origin_) + (line.b_mm - origin_));
    return toward / scale_ - kLeft * (flat.ax + flat.bx) - kUp * (flat.ay + flat.by);
  }

 private:
  OnPaper(const PaperAxes& axes, double scale) : axes_(axes), scale_(scale) {}

  /// Returns an unrounded point; in perspective, where nothing looks equal, `rounded`.
  [[nodiscard]] PaperPoint at(const geometry::Vec3d& mm, const PaperPoint& rounded) const {
    if (axes_.eye) return rounded;
    const geometry::Vec3d from = mm - origin_;
    return {dot(axes_.right, from) / scale_, -dot(axes_.up, from) / scale_};
  }

  const PaperAxes& axes_;
  double scale_;
  geometry::Vec3d origin_;
};

}  // namespace strake::drawing
