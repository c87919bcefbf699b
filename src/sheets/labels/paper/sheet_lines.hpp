// SPDX-License-Identifier: Apache-2.0
// All lines of a sheet that labels keep clear of.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Returns what is drawn in a view beside its lines, but for its labels.
[[nodiscard]] inline std::array<const Marks*, 5> marks_beside_lines(const PlacedView& view) {
  return {&view.caption, &view.grid, &view.frame, &view.notes, &view.match_lines};
}

/// Calls add(a, b) for each straight line of the views of a sheet, of their captions, frames, grid
/// lines and notes.
template <class Add>
void each_line(const Sheet& sheet, Add&& add) {
  const auto add_chain = [&](const std::vector<PaperPoint>& points) {
    for (std::size_t i = 1; i < points.size(); ++i) add(points[i - 1], points[i]);
  };
  for (const PlacedView& view : sheet.views) {
    for (const drawing::Line& line : view.ink.lines) add(line.a_paper, line.b_paper);
    for (const drawing::CentreLine& line : view.ink.centre_lines) add_chain(line.points);
    for (const drawing::BreakLine& line : view.ink.break_lines) add_chain(line.points);
    for (const Marks* marks : marks_beside_lines(view))
      for (const Path& path : marks->paths) add_chain(path.points);
  }
}

}  // namespace strake::sheets
