// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "strake/geometry/part_frame.hpp"
#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {

/// A stretch that two triangles have in common, one of each part: in the line of an edge (0..2)
/// of either where that is not negative.
struct CrossingPiece {
  std::uint32_t a = 0, b = 0;
  int edge_a = -1, edge_b = -1;
};

struct CrossingPieces {
  std::vector<CrossingPiece> all;
  bool truncated = false;  ///< there may be more
};

/// The stretches along which the skin of one part passes from one side of the other's to the other
/// side. Where they lie on each other, they cross if somewhere along the rim of that common area a
/// goes on to one side of b and elsewhere to the other; the stretches then are those of the rim
/// where it does so. Touching from one side is no crossing, nor is a sheet that ends on the other.
///
/// Exact. Stops after `most` stretches that cross outright, or after one of them that is `enough`.
/// The cost is that of the contacts.
[[nodiscard]] CrossingPieces crossing_pieces(
    const TreedPart& a, const TreedPart& b, std::size_t most, PairWork& work,
    const std::function<bool(const CrossingPiece&)>& enough = {});

/// The same, in any order; cheap also for parts that stand askew to the coordinate axes. Both
/// want a frame, and where want_trees() says so a tree.
[[nodiscard]] CrossingPieces crossing_pieces(const FramedPart& a, const FramedPart& b,
                                             std::size_t most, PairWork& work);

/// The same by every pair of triangles.
[[nodiscard]] std::vector<CrossingPiece> crossing_pieces_all(const PlacedPart& a,
                                                             const PlacedPart& b, PairWork& work);

}  // namespace strake::geometry
