// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/crossing_pieces.hpp"
#include "geometry/pair_view.hpp"
#include "geometry/parting/corner_moves.hpp"

namespace strake::geometry {

/// Where a triangle that holds a crossing piece, of b or of a, reaches through the other triangle
/// with a corner or an edge by little: those corners, each with the way back. Little is what lies
/// within `reach` grid units off the plane of the other. None where it passes through by more, or
/// lies in that plane.
[[nodiscard]] std::vector<CornerWay> ways_back(const PartView& a, const PartView& b,
                                               const CrossingPiece& piece, bool of_b,
                                               std::uint32_t triangle, double reach);

}  // namespace strake::geometry
