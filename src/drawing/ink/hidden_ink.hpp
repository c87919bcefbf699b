// SPDX-License-Identifier: Apache-2.0
// The choice of the hidden lines that get ink.
#pragma once

// Decision 0052 says why equal things get equal ink.

#include <array>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "drawing/collinear/collinear_overlaps.hpp"
#include "drawing/ink/line_grid.hpp"

namespace strake::drawing {

/// The dash and the gap of a dashed line in widths of its pen (ISO 128-20).
inline constexpr double kDash = 12, kDashGap = 3;
inline constexpr std::array<double, 2> kHiddenDashes{kDash, kDashGap};

/// A hidden line that gets ink unless there is ink beside it.
struct HiddenLine {
  PlaneSegment flat;
  double order = 0;                   ///< lines with the largest are laid down first
  std::uint32_t number = 0;           ///< number of the line, for the result; unique
  std::vector<ParamInterval> covers;  ///< the parts of it that lie on visible lines
};

/// Appends the intervals of the hidden lines of one object that get ink, by number; a line without
/// ink has none.
///
/// One line after the other is laid down where it does not run along an interval that is laid down
/// already. So a line that is left out covers nothing: of many lines that touch each other every
/// other one stays.
///
/// Cost: intervals that are laid down are found in grid cells, of which there are about as many as
/// lines; a cell has room for few lines of a direction. Once `stop` is requested, the rest is
/// missing.
void choose_hidden_lines(std::vector<HiddenLine>& lines, const LayingRule& rule,
                         const std::stop_token& stop, LineIntervals& out);

}  // namespace strake::drawing
