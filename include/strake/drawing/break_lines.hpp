// SPDX-License-Identifier: Apache-2.0
// Break lines where limits cut objects.
#pragma once

#include <vector>

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// Returns break lines, narrow lines with zigzags (ISO 128-3), across the ends of visible lines
/// that the limits of the view cut. They follow from the drawing alone.
///
/// A side of the limits that is seen edge-on has one line on paper: what is cut there, from the
/// first to the last cut line of each object, gets one break line where objects meet or overlap.
/// Where a side is seen askew, each object has its own, between the two cut ends that are farthest
/// apart. A side that is seen square has none, nor has an object of which it cuts a single line.
/// Break lines go on for 2 mm beyond what they cross, less where that is narrower than 4 mm; those
/// of two sides that are seen edge-on and that both end within 4 mm of the corner between them meet
/// there. A line has a zigzag for each 80 mm, 64 at most. The result does not depend on the team.
/// Errors: cancelled.
[[nodiscard]] Result<std::vector<BreakLine>> find_break_lines(const NeutralDrawing& drawing,
                                                              const parallel::Context& context);

}  // namespace strake::drawing
