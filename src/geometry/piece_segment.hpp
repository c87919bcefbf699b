// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "geometry/crossing_pieces.hpp"
#include "geometry/pair_view.hpp"

namespace strake::geometry {

using DoubleSegment = std::array<Vec3d, 2>;

/// Where a crossing piece lies, rounded: grid units in the coordinates of the views. None where it
/// is too short to tell.
[[nodiscard]] std::optional<DoubleSegment> segment_of(const PartView& a, const PartView& b,
                                                      const CrossingPiece& piece);

}  // namespace strake::geometry
