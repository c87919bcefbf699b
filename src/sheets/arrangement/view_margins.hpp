// SPDX-License-Identifier: Apache-2.0
// The paper that marks beside the lines of a view need: grid lines, levels, cutting planes,
// dimensions, or the frame of a view in perspective.
#pragma once

#include "sheets/spec/sheet_spec.hpp"

namespace strake::sheets {

/// Match lines go on by so much beyond the lines of a view, as grid lines do before their labels.
inline constexpr double kMatchBeyondMm = 4;

struct ViewMargins {
  double left_mm = 0, top_mm = 0, right_mm = 0, bottom_mm = 0;
};

/// Returns the box with these margins.
[[nodiscard]] inline PaperBox with_margins(const PaperBox& box, const ViewMargins& margins) {
  return {box.left - margins.left_mm, box.top - margins.top_mm, box.right + margins.right_mm,
          box.bottom + margins.bottom_mm};
}

/// Returns the paper that the dimensions beside the lines of a view need: those of its horizontal
/// and its vertical.
[[nodiscard]] ViewMargins dimension_margins(const SheetSpec& what, const ViewSpec& view);

/// Returns that and, beyond it, the paper of the labels of grid lines and levels. Cutting planes
/// end beyond that, where their arrows and letters cover no label.
[[nodiscard]] ViewMargins label_margins(const SheetSpec& what, const ViewSpec& view);

/// Returns the paper beside the lines of a view that all its marks need; its title stands below
/// that.
[[nodiscard]] ViewMargins margins_of(const SheetSpec& what, const ViewSpec& view);

}  // namespace strake::sheets
