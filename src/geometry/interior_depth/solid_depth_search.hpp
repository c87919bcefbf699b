// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>

#include "geometry/interior_depth/surface_distance/distance_field.hpp"

namespace strake::geometry {

[[nodiscard]] inline bool is_decided(const Depth& d, const DepthOptions& goal) {
  return d.lower > goal.threshold || d.upper <= goal.threshold;
}

/// Whether the bracket is no wider than `relative` times the depth, or than the goal's tolerance.
[[nodiscard]] inline bool is_tight(const Depth& d, const DepthOptions& goal, double relative) {
  return d.upper - d.lower <= std::max(goal.tolerance, relative * d.upper);
}

[[nodiscard]] inline bool bracket_suffices(const Depth& d, const DepthOptions& goal) {
  return is_decided(d, goal) && is_tight(d, goal, goal.relative);
}

/// Narrows the bracket of two solids: points climb to local maxima, from `seeds` and from each
/// deeper point found, and levels above these are searched until none may be deeper. Coordinates
/// are relative to a's origin; the fields are prepared for many queries.
void search_solid_depth(const DistanceField& a, const DistanceField& b, const DepthOptions& goal,
                        std::span<const Vec3d> seeds, Depth& depth, QueryContext& work);

}  // namespace strake::geometry
