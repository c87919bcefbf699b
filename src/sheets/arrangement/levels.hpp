// SPDX-License-Identifier: Apache-2.0
// Marks of heights beside elevations.
#pragma once

#include <string>
#include <vector>

#include "sheets/spec/sheet_spec.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Returns "DECK 1 +1.800", in metres; a height of nothing is ±0.000.
[[nodiscard]] std::string level_text(const LevelSpec& level);

/// Returns the paper that the levels need at the right of a view; 0 where it shows none: it is no
/// elevation, z up.
[[nodiscard]] double level_margin(const LevelsSpec& levels, const ViewSpec& view);

/// Appends the levels of a view: right of `right_mm`, beside its lines, a short line at each
/// height, a triangle that points at it, and the value in metres with three decimals, after its
/// label. A level that misses the view is left out, and so is one whose text would touch that of
/// the one below. Returns which levels lie within the height of the view.
std::vector<bool> mark_levels(const LevelsSpec& levels, const ViewSpec& view,
                              const drawing::Placement& placement, const PaperBox& box,
                              double right_mm, Marks& marks);

}  // namespace strake::sheets
