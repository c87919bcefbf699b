// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/piece_segment.hpp"
#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {

/// Where two sheets cross: segments in grid units relative to a's origin.
struct CrossingCurve {
  std::vector<DoubleSegment> segments;
  std::vector<CrossingPiece> pieces;  ///< by segment: what it is part of
  bool crosses = false;               ///< though it may be in segments too short to tell
  bool truncated = false;             ///< there may be more
};

/// The segments of crossing_pieces() that moves of up to `within` grid units do not undo
/// (lasting_pieces()): which these are is exact, where they lie is rounded.
[[nodiscard]] CrossingCurve crossing_curve(const TreedPart& a, const TreedPart& b, double within,
                                           std::size_t most, PairWork& work);

}  // namespace strake::geometry
