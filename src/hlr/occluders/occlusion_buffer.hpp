// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// What of a segment, by parameters, is certainly hidden on both sides: [lo, from] and [to, hi];
/// all of it where from >= to.
struct CoveredEnds {
  double from = 0, to = 1;
};

/// For each tile of the paper how near to the viewer it is wholly covered: one polygon's open
/// inside holds the closed tile, and all of the polygon over the tile is nearer than that by more
/// than any contact distance. A bound from below, so that what lies deeper is hidden without a look
/// at what hides it (the farthest-depth map of Greene, Kass and Miller, 1993, with exact coverage).
class OcclusionBuffer {
 public:
  /// Covers nothing.
  OcclusionBuffer() = default;

  /// Of the bodies that may hide and that no limits cut. `tiles`: about how many of them.
  /// Errors: cancelled.
  [[nodiscard]] static Result<OcclusionBuffer> of(std::span<const BodyInstance> placed,
                                                  const ViewProjection& projection,
                                                  std::int64_t contact, std::size_t tiles,
                                                  const parallel::Context& context);

  [[nodiscard]] bool empty() const { return depth_.empty(); }

  /// The ends, or all, of the part [lo, hi] of a segment that lie deeper than what covers them.
  [[nodiscard]] CoveredEnds covered_ends(const ViewPoint& a, const ViewPoint& b, double lo,
                                         double hi) const;

 private:
  class Painter;
  class Walk;

  double u0_ = 0, v0_ = 0;         ///< corner of the first tile
  double width_ = 1, height_ = 1;  ///< of a tile
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<float> depth_;  ///< by row, then column; minus infinity where nothing covers
};

}  // namespace strake::hlr
