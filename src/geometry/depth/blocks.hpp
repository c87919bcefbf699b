// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "geometry/depth/depth_field.hpp"
#include "geometry/depth/search_frame.hpp"

namespace strake::geometry {

/// How far, grid units, a common box may stand off the parts that it holds.
inline constexpr double kStandOff = 1;

/// A box of space in the coordinates of a frame, relative to the common origin.
struct Block {
  Box3d box;
  /// No point of the block that is in both parts is deeper in the first, and in the second.
  std::array<double, 2> upper{};
  /// Where that bound is attained, relative to the common origin.
  std::array<Vec3d, 2> promise{};

  [[nodiscard]] double most() const { return upper[0] > upper[1] ? upper[0] : upper[1]; }
};

/// Cuts a box along the faces of two parts that are square to a frame, and leaves out what lies
/// outside either part. Beams, plates and whatever else is made of boxes fall into pieces that are
/// wholly inside, between parallel faces, and the bound of such a piece is exact.
///
/// Each cut runs a little outside the face, and the bound is taken over the block without that
/// little: depth changes by no more than the way. Parts of many triangles are not cut.
[[nodiscard]] std::vector<Block> cut_into_blocks(const DepthField& a, const DepthField& b,
                                                 const Axes& axes, const Box3d& box, double slack,
                                                 PairWork& work);

}  // namespace strake::geometry
