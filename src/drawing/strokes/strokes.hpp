// SPDX-License-Identifier: Apache-2.0
// Chains of lines as strokes of a pen: runs of straight lines and of chords of one curve.
#pragma once

#include <cstddef>
#include <vector>

#include "drawing/strokes/join_lines.hpp"
#include "strake/drawing/drawing.hpp"

namespace strake::drawing {

/// A run of a stroke: straight lines, or an arc of one curve, one way round.
struct StrokeRun {
  const PaperCurve* curve = nullptr;  ///< null: straight lines
  bool forward = true;                ///< an arc: its parameter grows from `first` to `last`
  std::size_t first = 0, last = 0;    ///< its points in Stroke::points, both included
};

/// What is drawn without lifting the pen; runs follow each other, each from the last point of the
/// one before.
struct Stroke {
  Chain points;  ///< of an arc: the ends of the chords that stand for it
  std::vector<StrokeRun> runs;

  [[nodiscard]] bool closed() const { return points.size() > 3 && points.front() == points.back(); }
};

/// Finds the runs of a chain. A closed chain is turned to begin where one curve ends and another
/// begins; a curve that is seen nearly edge-on, narrower than a pen, stays straight.
[[nodiscard]] Stroke stroke_of(const JoinedLines& chain, const PaperCurves& curves);

/// An ellipse by its axes.
struct EllipseAxes {
  double major = 0, minor = 0;  ///< half the axes, mm of paper
  double turn_rad = 0;          ///< of the major axis, from x towards y; a circle's is 0
};
[[nodiscard]] EllipseAxes axes_of(const PaperCurve& curve);

/// Returns whether the parameter grows from y towards x, which on paper is against the clock.
[[nodiscard]] bool is_left_handed(const PaperCurve& curve);

/// Returns the parameter of a point on the curve, or of the curve's point that it is beside, from
/// -π to π.
[[nodiscard]] double curve_parameter(const PaperCurve& curve, const PaperPoint& point);

/// Returns how far the parameter goes from a point to another, the shorter way round; negative
/// backwards.
[[nodiscard]] double turn_between(const PaperCurve& curve, const PaperPoint& from,
                                  const PaperPoint& to);

/// Returns the length of the shorter arc of a curve between two of its points, to the fourth order
/// of their distance; where the curve is null, that of the straight line.
[[nodiscard]] double length_along(const PaperCurve* curve, const PaperPoint& a,
                                  const PaperPoint& b);

/// Returns how far the parameter goes along an arc of a stroke, chord by chord: 2π for a full turn,
/// negative backwards.
[[nodiscard]] double turn_of(const Stroke& stroke, const StrokeRun& arc);

}  // namespace strake::drawing
