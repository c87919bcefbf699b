// SPDX-License-Identifier: Apache-2.0
// Match lines: where a view ends, and which view goes on there.
#pragma once

#include <cstddef>
#include <span>

#include "sheets/arrangement/view_paper.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Appends a match line along the side that a view shares with its neighbour, as far as the two
/// have it in common, or to a little beyond the lines of the view where its limits end; beside it,
/// outside of the view, which view goes on there, and on which sheet unless it is this one. The
/// text stands where it covers nothing of `taken`. Returns whether it was drawn: not where the
/// lines of the view end long before the side.
[[nodiscard]] bool draw_match_line(const NeighbourView& neighbour, std::size_t sheet_number,
                                   const MarkedView& in, double letters_mm,
                                   std::span<const PaperBox> taken, Marks& marks);

}  // namespace strake::sheets
