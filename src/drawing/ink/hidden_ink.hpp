// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0052 says why equal things get equal ink.

#include <cstdint>
#include <stop_token>
#include <vector>

#include "drawing/collinear/collinear_overlaps.hpp"

namespace strake::drawing {

/// A dashed line in widths of its pen (ISO 128-20).
inline constexpr double kDash = 12, kDashGap = 3;

struct HiddenInkRule {
  OverlapRule overlap;
  double whole_below = 0;  ///< lines shorter than this go or stay as a whole
  double touch = 0;        ///< lengths that differ by no more are equal
};

/// A hidden line that gets ink unless there is some beside it.
struct HiddenLine {
  PlaneSegment flat;
  double order = 0;                   ///< lines are laid down by it, the largest first
  std::uint32_t number = 0;           ///< of the line, for the result; different for each
  std::vector<ParamInterval> covers;  ///< what of it lies on visible lines
};

/// Appends the stretches of the hidden lines of one object that get ink, by number; none of a line
/// that gets none.
///
/// One line after the other is laid down where it does not run along a stretch that lies there
/// already. So nothing is left out for the sake of what is left out itself: of many lines that
/// touch each other every other one stays.
///
/// Cost: what is laid down is found in cells, of which there are about as many as lines; a cell has
/// room for few lines of a direction. Once it is to stop, the rest is missing.
void choose_hidden_lines(std::vector<HiddenLine>& lines, const HiddenInkRule& rule,
                         const std::stop_token& stop, LineIntervals& out);

}  // namespace strake::drawing
