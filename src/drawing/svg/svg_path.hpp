// SPDX-License-Identifier: Apache-2.0
// Lines joined into chains, and the commands of SVG paths for them.
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "strake/drawing/drawing.hpp"

namespace strake::drawing {

/// Points to be joined by straight lines; closed when the last is the first.
using Chain = std::vector<PaperPoint>;

/// A chain, and for each segment between two of its points the line that it comes from.
struct JoinedLines {
  Chain points;
  std::vector<const Line*> lines;
};

[[nodiscard]] inline double distance(const PaperPoint& a, const PaperPoint& b) {
  const double x = b.x - a.x, y = b.y - a.y;
  return std::sqrt(x * x + y * y);
}

/// Joins lines that meet end to end on paper into chains, each line once.
///
/// A chain begins with the first remaining line that has a free end, or else with the first
/// remaining line, and at a fork goes on with the first: the order of the lines alone decides.
/// Lines without length are left out.
[[nodiscard]] std::vector<JoinedLines> join_lines(std::span<const Line* const> lines);

/// Appends the commands of a path of straight lines: "M0 0L1 0 1 1Z".
void append_svg_chain(std::string& out, const Chain& chain);

/// Appends a path with an elliptical arc ("A") for each run of chords of one curve. The arc begins
/// and ends where the run does; a curve that is seen edge-on stays straight.
void append_svg_path(std::string& out, const JoinedLines& chain, const PaperCurves& curves);

}  // namespace strake::drawing
