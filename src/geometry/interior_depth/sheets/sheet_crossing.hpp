// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0040 says why all regions share one curve.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "strake/geometry/depth.hpp"

namespace strake::geometry {

/// The crossing of two sheets, found once for all queries: how deep they cross as a whole, or in
/// each contact region. The parts and their trees must outlive it.
///
/// Building costs as much as the contacts; a query costs a logarithm for each of its segments.
class SheetCrossing {
 public:
  /// The two triangles that share a segment of the intersection curve.
  struct CrossingSegment {
    std::uint32_t triangle_a = 0, triangle_b = 0;
  };

  /// Finds the crossing, without what vertex displacements of up to `apart_within` grid units undo.
  SheetCrossing(const PartWithBvh& a, const PartWithBvh& b, double apart_within,
                QueryContext& work);

  [[nodiscard]] const std::vector<CrossingSegment>& crossing_segments() const;

  /// Returns sheet_crossing_depth(); the goal's `apart_within` is the one given to the constructor.
  [[nodiscard]] Depth depth(const DepthOptions& goal, QueryContext& work) const;
  /// Returns the depth along some of the segments, by number. Their list may be incomplete where
  /// there are very many: the upper bound accounts for it.
  [[nodiscard]] Depth depth_along(std::span<const std::uint32_t> some, const DepthOptions& goal,
                                  QueryContext& work) const;

 private:
  struct Curves;
  std::shared_ptr<const Curves> curves_;
};

}  // namespace strake::geometry
