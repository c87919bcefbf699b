// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/bvh.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/context.hpp"

namespace strake::geometry {

/// A second box for each of some items, in one of a few frames: tight for what is long and thin
/// and stands askew, where boxes along the coordinate axes all meet.
struct FramedBoxes {
  std::vector<Mat3d> frames;         ///< by rows: unit axes, at right angles but for rounding
  Vec3l origin;                      ///< where the frames have their zero
  std::vector<std::uint32_t> frame;  ///< by item
  std::vector<Box3l> box;            ///< by item, in its frame, with room for rounding
};

/// Every pair of items as meeting_pairs() of their tree gives it, of which the second boxes are not
/// parted either, by a face of one of the two or a plane along an edge of each.
[[nodiscard]] Result<std::vector<IndexPair>> meeting_pairs(std::span<const BoxItem> items,
                                                           const FramedBoxes& framed,
                                                           const parallel::Context& context,
                                                           std::uint64_t most = kMostPairs);

/// The same by the nested loop.
[[nodiscard]] Result<std::vector<IndexPair>> meeting_pairs_all(std::span<const BoxItem> items,
                                                               const FramedBoxes& framed,
                                                               const parallel::Context& context,
                                                               std::uint64_t most = kMostPairs);

}  // namespace strake::geometry
