// SPDX-License-Identifier: Apache-2.0
// What a view shows of objects, and where leaders to them may end.
#pragma once

#include <vector>

#include "sheets/spec/paper_segments.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/model/model.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// An object with visible lines.
struct VisibleObject {
  model::ObjectId object{};
  PaperSegment longest;  ///< its longest visible line
  PaperBox box;          ///< box of its visible lines
  double length = 0;     ///< length of all of them
};

/// Returns the picked objects that have visible lines, in the order of the model.
[[nodiscard]] std::vector<VisibleObject> visible_objects(const drawing::Ink& ink,
                                                         const std::vector<bool>& picked);

/// Returns where leaders to an object may end: the middle of its longest visible line and, on long
/// ones, the quarters.
[[nodiscard]] std::vector<PaperPoint> anchors_of(const PaperSegment& longest);

}  // namespace strake::sheets
