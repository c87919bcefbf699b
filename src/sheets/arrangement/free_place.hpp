// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// The paper on which views may lie.
struct SheetArea {
  PaperBox area;
  std::vector<PaperBox> keep_free;

  [[nodiscard]] bool takes(const PaperBox& box) const;
};

/// Returns where a box of so much paper has the most room: within the area, clear of what is kept
/// free and apart from the others by `gap_mm`, in the middle of the room on both sides of it.
/// Nothing where it has none.
[[nodiscard]] std::optional<PaperBox> free_place(double width_mm, double height_mm,
                                                 std::span<const PaperBox> others,
                                                 const SheetArea& room, double gap_mm);

}  // namespace strake::sheets
