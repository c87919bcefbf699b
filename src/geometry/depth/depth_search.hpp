// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>

#include "geometry/depth/depth_field.hpp"

namespace strake::geometry {

[[nodiscard]] inline bool is_decided(const Depth& d, const DepthGoal& goal) {
  return d.lower > goal.threshold || d.upper <= goal.threshold;
}

/// Whether the bracket is no wider than this relative to the depth, or than the goal's tolerance.
[[nodiscard]] inline bool is_tight(const Depth& d, const DepthGoal& goal, double relative) {
  return d.upper - d.lower <= std::max(goal.tolerance, relative * d.upper);
}

[[nodiscard]] inline bool bracket_suffices(const Depth& d, const DepthGoal& goal) {
  return is_decided(d, goal) && is_tight(d, goal, goal.relative);
}

/// Narrows the bracket of two solids: points climb to where they are deepest nearby, from `seeds`
/// and from each deeper point found, and levels above it are asked for until none is left that may
/// be deeper. Coordinates are relative to a's
/// origin; the fields are prepared for many questions.
void search_solid_depth(const DepthField& a, const DepthField& b, const DepthGoal& goal,
                        std::span<const Vec3d> seeds, Depth& depth, PairWork& work);

}  // namespace strake::geometry
