// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sheets/spec/sheet_spec.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Returns whether a file requests grid lines across this axis in a view that looks along them.
[[nodiscard]] bool shows_grid(const GridSpec& grid, const ViewSpec& view, std::uint8_t axis);

/// The paper that grid lines need beside a view, for their ends and labels.
struct GridMargin {
  double left_mm = 0, top_mm = 0, other_mm = 0;
};
[[nodiscard]] GridMargin grid_margin(const GridSpec& grid, const ViewSpec& view);

struct GridMarks {
  Marks marks;
  std::vector<bool> drawn;     ///< whether each plane of the file is drawn
  std::size_t unlabelled = 0;  ///< lines that are drawn without a label, for want of room
};

/// Returns the grid lines of a view: those that meet the box of its lines. They run across a box
/// round that, with its dimensions, and a little beyond, with labels at the upper or the left end.
/// Where labels would touch, every second, fifth, tenth … is kept.
[[nodiscard]] GridMarks grid_marks(const GridSpec& grid, const ViewSpec& view,
                                   const drawing::Placement& placement, const PaperBox& lines,
                                   const PaperBox& dimensioned);

}  // namespace strake::sheets
