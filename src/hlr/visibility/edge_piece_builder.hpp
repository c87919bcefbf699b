// SPDX-License-Identifier: Apache-2.0
// The engine's second step for one edge: make its pieces of what hides it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hlr/visibility/specks.hpp"
#include "hlr/visibility/visibility_intervals.hpp"
#include "hlr/visibility/visibility_scene.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// Makes the pieces of one edge after another from its hidden intervals. For one worker; it keeps
/// its memory from edge to edge.
class EdgePieceBuilder {
 public:
  EdgePieceBuilder(const VisibilityScene& visibility, const SpeckRule& rule)
      : visibility_(visibility), rule_(rule) {}

  /// Begins with an edge. True when finish() needs the intervals that are hidden between lo() and
  /// hi(); else all of the edge is clipped, or a point on paper.
  [[nodiscard]] bool begin(const EdgeQuery& edge);
  [[nodiscard]] const RationalParam& lo() const { return lo_; }
  [[nodiscard]] const RationalParam& hi() const { return hi_; }
  /// Returns whether nothing of the edge is clipped.
  [[nodiscard]] bool is_whole() const { return lo_.num == 0 && hi_.num == hi_.den; }

  /// Returns whether all of the edge is clipped.
  [[nodiscard]] bool is_clipped() const { return whole_ == State::clipped; }

  /// What finish() did with the pieces of an edge.
  struct Outcome {
    UnwantedPieces left_out;  ///< what it did not append
    std::size_t specks = 0;   ///< specks that other pieces absorbed
    bool specked = false;     ///< it appended visible specks
  };
  /// Appends the pieces of the current edge, which has this number within its object.
  Outcome finish(std::uint32_t number, std::span<const OcclusionInterval> intervals,
                 std::vector<EdgePiece>& out);

 private:
  const VisibilityScene& visibility_;
  EdgeQuery edge_;
  RationalParam lo_ = RationalParam::zero(), hi_ = RationalParam::one();
  State whole_ = State::visible;  ///< the state of all of the edge, where it has one
  std::vector<VisibilityInterval> intervals_;
  IntervalSweep sweep_;
  const SpeckRule& rule_;
};

}  // namespace strake::hlr
