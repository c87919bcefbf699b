// SPDX-License-Identifier: Apache-2.0
// Scale bar and north of a sheet.
#pragma once

#include <string>

#include "sheets/spec/sheet_spec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// The paper that a scale bar takes, whatever the scale: from the upper left corner of its bar's
/// numbers.
inline constexpr double kScaleBarWidthMm = 96, kScaleBarHeightMm = 8;
/// Half the paper, to each side of its middle, that a north mark takes.
inline constexpr double kNorthReachMm = 10;

/// Appends a scale bar: a round length of the model, 32 to 80 mm of paper, in parts of which every
/// second is filled, with numbers and the unit.
void draw_scale_bar(const PaperPoint& upper_left, double scale, Marks& marks);

/// Returns whether a view shows a direction: it looks across it, not along it, and has no
/// perspective.
[[nodiscard]] bool shows_direction(const hlr::View& view, const geometry::Vec3l& direction);

/// Appends an arrow that points north in a view, in a circle, with an N before its tip. The view
/// shows the direction.
void draw_north(const PaperPoint& middle, const hlr::View& view, const geometry::Vec3l& direction,
                Marks& marks);

}  // namespace strake::sheets
