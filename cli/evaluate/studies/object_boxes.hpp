// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cli/evaluate/contender.hpp"
#include "cli/evaluate/placed_model.hpp"
#include "geometry/bvh/scene_bvh.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::cli {

/// Returns the box of each object, in grid units, half a clearance larger on each side; empty for
/// one without bodies.
[[nodiscard]] std::vector<geometry::Box3l> object_boxes(const PlacedModel& model,
                                                        double clearance_mm);

/// Whether two boxes share a point: at most six comparisons.
[[nodiscard]] inline bool meet(const geometry::Box3l& x, const geometry::Box3l& y) {
  for (int k = 0; k < 3; ++k)
    if (x.lo[k] > y.hi[k] || y.lo[k] > x.hi[k]) return false;
  return true;
}

/// Returns pairs of boxes as what a contender came to; they are compared whatever their order.
[[nodiscard]] Computed computed_of(std::vector<geometry::IndexPair> pairs);

}  // namespace strake::cli
