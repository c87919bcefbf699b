// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0062 says what would have to be shown before this buffer were filled on a GPU.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hlr/occluders/projected_shape.hpp"
#include "hlr/view/projection.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A part of a segment, by parameters.
struct SegmentRange {
  double lo = 0, hi = 1;
};

/// A conservative tile z-buffer: for each tile of the paper a depth at which it is wholly covered.
/// One polygon's open inside holds the closed tile, or the outline of one convex part, and all of
/// the polygon or part over the tile is nearer than that by more than any contact distance. As the
/// depth is a lower bound, what lies deeper is hidden with no test of its occluders (the
/// farthest-depth map of Greene, Kass and Miller, 1993, with exact coverage).
class OcclusionBuffer {
 public:
  /// A buffer that covers nothing.
  OcclusionBuffer() = default;

  /// Builds the buffer from the bodies that may hide and that no limits cut. `tiles`: the
  /// approximate number of tiles.
  /// Errors: cancelled.
  [[nodiscard]] static Result<OcclusionBuffer> of(std::span<const BodyInstance> placed,
                                                  const ViewProjection& projection,
                                                  std::int64_t contact, std::size_t tiles,
                                                  const parallel::Context& context);

  [[nodiscard]] bool empty() const { return depth_.empty(); }

  /// Finds the gaps of a buffer that is not empty: what of the part [lo, hi] of a segment is not
  /// certainly hidden on both sides. Ascending, none meets the next, kMaxGaps at most: then the
  /// last is longer than it need be. The joints of plates leave such gaps, as no plate covers the
  /// tiles there alone.
  void find_gaps(const ViewPoint& a, const ViewPoint& b, const SegmentRange& part,
                 std::vector<SegmentRange>& gaps) const;

  /// Returns whether all that lies in a box on paper lies deeper than the buffer: quick, and false
  /// where the box is large.
  [[nodiscard]] bool covers(const ViewBox& box) const;

 private:
  class Rows;
  class Painter;
  class TileTraversal;

  double u0_ = 0, v0_ = 0;         ///< corner of the first tile
  double width_ = 1, height_ = 1;  ///< size of a tile
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<float> depth_;  ///< by row, then column; minus infinity where nothing covers the tile
};

}  // namespace strake::hlr
