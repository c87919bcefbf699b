// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clash/narrow_part.hpp"

namespace strake::clash {

/// The depth of two parts whose interiors meet, of whatever kinds; its point and the goal's are
/// relative to a's origin. Both have planes, but for two sheets.
[[nodiscard]] geometry::Depth depth_of(const NarrowPart& a, const NarrowPart& b,
                                       const geometry::DepthGoal& goal, NarrowWork& work);

}  // namespace strake::clash
