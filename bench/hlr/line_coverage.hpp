// SPDX-License-Identifier: Apache-2.0
// Whether two drawings of one view show the same, whoever made them.
#pragma once

#include <vector>

#include "drawing/collinear/collinear_overlaps.hpp"
#include "strake/parallel/context.hpp"

namespace strake::bench {

/// Lengths on paper, mm. What lies on each other counts once.
struct Common {
  double ours = 0, theirs = 0;
  double missing = 0;  ///< of ours, where they have nothing
  double extra = 0;    ///< of theirs, where we have nothing
};

/// Lines lie on each other where they are no more than half a millimetre apart. Rank, depth and
/// reach are set here.
[[nodiscard]] Common compare(const std::vector<drawing::PlaneSegment>& ours,
                             const std::vector<drawing::PlaneSegment>& theirs,
                             const parallel::Context& context);

}  // namespace strake::bench
