// SPDX-License-Identifier: Apache-2.0
// What views say of each other: where one is cut, and what one shows of another.
#pragma once

#include <string>
#include <vector>

#include "sheets/arrangement/view_paper.hpp"
#include "sheets/spec/sheet_spec.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Returns the boxes of what is already drawn beside a view: texts, bubbles, and the wide ends and
/// arrows of cutting planes, with a little paper round them.
[[nodiscard]] std::vector<PaperBox> taken_boxes(const Marks& marks);

/// Appends the cutting plane of `cut` to a view that sees it edge-on (ISO 128-3): a long dashed
/// dotted line, interrupted where there are labels beside the lines of the view, with wide ends
/// beyond them, arrows in the direction of viewing, and its letter beside them. The ends stand
/// farther out where they would cover labels of the grid. Several planes give a line each; those
/// that miss the view none. Returns whether there was one.
[[nodiscard]] bool mark_section(const ViewSpec& cut, const MarkedView& in, double letters_mm,
                                const Marks& grid, Marks& marks);

/// Appends the outline of a box of the model, mm, with a name at its upper left corner or so far
/// above it that it covers no label of the grid and no mark; a view in perspective gets none.
/// Returns whether there was one.
[[nodiscard]] bool mark_extent(const geometry::Box3d& extent, const std::string& name,
                               const MarkedView& in, double letters_mm, const Marks& grid,
                               Marks& marks);

}  // namespace strake::sheets
