// SPDX-License-Identifier: Apache-2.0
// Lines joined into chains.
#pragma once

#include <cmath>
#include <span>
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

}  // namespace strake::drawing
