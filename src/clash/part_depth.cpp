// SPDX-License-Identifier: Apache-2.0
#include "clash/part_depth.hpp"

namespace strake::clash {

using geometry::DepthGoal;
using geometry::DepthPart;
using geometry::PartKind;
using geometry::Vec3d;

geometry::Depth depth_of(const NarrowPart& a, const NarrowPart& b, const DepthGoal& goal,
                         NarrowWork& work) {
  const bool sheet_a = a.treed.placed.part->kind == PartKind::sheet;
  const bool sheet_b = b.treed.placed.part->kind == PartKind::sheet;
  if (sheet_a && sheet_b) return geometry::sheet_crossing_depth(a.treed, b.treed, goal, work.pair);
  const DepthPart x{a.treed, a.planes}, y{b.treed, b.planes};
  if (sheet_a) return geometry::sheet_in_solid_depth(x, y, goal, work.pair);
  if (sheet_b) {
    const Vec3d shift = (b.treed.placed.origin - a.treed.placed.origin).as<double>();
    DepthGoal of_sheet = goal;
    if (goal.within) of_sheet.within = {goal.within->lo - shift, goal.within->hi - shift};
    if (goal.belongs) of_sheet.belongs = [&](const Vec3d& p) { return goal.belongs(p + shift); };
    geometry::Depth depth = geometry::sheet_in_solid_depth(y, x, of_sheet, work.pair);
    depth.point = depth.point + shift;
    return depth;
  }
  return geometry::solid_depth(x, y, goal, work.pair);
}

}  // namespace strake::clash
