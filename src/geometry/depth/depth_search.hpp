// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/depth/depth_field.hpp"

namespace strake::geometry {

[[nodiscard]] inline bool bracket_suffices(const Depth& d, const DepthGoal& goal) {
  const bool decided = d.lower > goal.threshold || d.upper <= goal.threshold;
  return decided && d.upper - d.lower <= std::fmax(goal.tolerance, goal.relative * d.upper);
}

/// Narrows the bracket of two solids by best-first branch and bound over their common region;
/// coordinates are relative to a's origin.
void search_solid_depth(const DepthField& a, const DepthField& b, const DepthGoal& goal,
                        Depth& depth, PairWork& work);

}  // namespace strake::geometry
