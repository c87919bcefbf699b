// SPDX-License-Identifier: Apache-2.0
// Where a view shows that an object runs straight on: the axes of its pipes, or its longest lines.
#pragma once

#include <vector>

#include "sheets/spec/paper_segments.hpp"
#include "strake/model/model.hpp"
#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// A straight part of an object on paper.
struct StraightRun {
  PaperSegment line;   ///< the axis of what is round, or else a line of the object
  double half_mm = 0;  ///< how far what is round reaches to both sides of its axis
};

/// Returns the straight runs of an object, the longest first: the axes of its exact round bodies as
/// far as visible lines run beside them, what lies in line as one; of an object without such axes,
/// of a pipe that is drawn as a single line or as a mesh, its straight visible lines.
[[nodiscard]] std::vector<StraightRun> straight_runs(const PlacedView& view,
                                                     const model::Model& model,
                                                     model::ObjectId object);

}  // namespace strake::sheets
