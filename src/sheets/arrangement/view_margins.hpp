// SPDX-License-Identifier: Apache-2.0
// The paper that marks beside the lines of a view need: grid lines, levels, cutting planes,
// dimensions, or the frame of a view in perspective.
#pragma once

#include "sheets/spec/sheet_spec.hpp"

namespace strake::sheets {

struct ViewMargins {
  double left_mm = 0, top_mm = 0, right_mm = 0, bottom_mm = 0;
};

/// Returns the paper beside the lines of a view that its marks need; its title stands below that.
[[nodiscard]] ViewMargins margins_of(const SheetSpec& what, const ViewSpec& view);

}  // namespace strake::sheets
