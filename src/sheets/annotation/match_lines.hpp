// SPDX-License-Identifier: Apache-2.0
// Match lines: where a view ends, and which view goes on there.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "sheets/arrangement/view_paper.hpp"
#include "sheets/spec/paper_segments.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Appends a match line along the side that a view shares with its neighbour, as far as the two
/// have it in common, or to a little beyond the lines of the view where its limits end; beside it,
/// outside of the view, which view goes on there, and on which sheet unless it is this one. The
/// text stands where it covers nothing of `taken`. Returns the line; none: the lines of the view
/// end long before the side.
[[nodiscard]] std::optional<PaperSegment> draw_match_line(const NeighbourView& neighbour,
                                                          std::size_t sheet_number,
                                                          const MarkedView& in, double letters_mm,
                                                          std::span<const PaperBox> taken,
                                                          Marks& marks);

/// Takes out of a view what a match line stands in the place of: break lines that lie on it, and
/// grid lines as far as they do.
void clear_below(const PaperSegment& match_line, PlacedView& view);

}  // namespace strake::sheets
