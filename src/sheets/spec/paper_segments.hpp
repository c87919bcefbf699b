// SPDX-License-Identifier: Apache-2.0
// Straight lines on paper: what of one lies in a box, whether two cross, and how a text along one
// is read.
#pragma once

#include <optional>

#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

struct PaperSegment {
  PaperPoint a, b;
};

[[nodiscard]] double length_of(const PaperSegment& segment);

/// Returns the box with a rim of so many millimetres round it.
[[nodiscard]] inline PaperBox widened(const PaperBox& box, double by_mm) {
  return {box.left - by_mm, box.top - by_mm, box.right + by_mm, box.bottom + by_mm};
}

/// Returns the part of a segment that lies in a box (Liang and Barsky); none where it misses.
[[nodiscard]] std::optional<PaperSegment> clipped(const PaperSegment& segment, const PaperBox& box);

/// Returns whether two segments cross. Those that share an end or lie in one line do not.
[[nodiscard]] bool segments_cross(const PaperSegment& one, const PaperSegment& other);

/// Returns the direction in which a text along a line is read (ISO 129-1): from below, and along an
/// upright line from the right.
[[nodiscard]] PaperPoint reading_way(const PaperPoint& way);
/// Returns how far a text is turned that is read in a direction, as Text::turn_deg.
[[nodiscard]] double reading_turn(const PaperPoint& way);

}  // namespace strake::sheets
