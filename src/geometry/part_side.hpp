// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geometry/turned_part.hpp"
#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {

/// As side_of() of the header beside the part pairs; by the boxes of a frame of the part's own, if
/// there is one, which changes only the work.
[[nodiscard]] PointSide side_of(const TreedPart& part, const Vec3l& numerator,
                                std::int64_t denominator, PairWork& work, const TurnedFrame* frame);

}  // namespace strake::geometry
