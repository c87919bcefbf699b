// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0040 says why all regions share one curve.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "strake/geometry/depth.hpp"

namespace strake::geometry {

/// Where two sheets cross, found once for all that is asked about it: how deep they cross as a
/// whole, or in each of the places where they do. The parts and their trees must live.
///
/// Building costs what the contacts cost; a question a logarithm for each stretch that it is about.
class SheetCrossing {
 public:
  /// The two triangles that have a stretch of the common curve.
  struct Stretch {
    std::uint32_t triangle_a = 0, triangle_b = 0;
  };

  /// What moves of corners of up to `apart_within` grid units undo is no crossing.
  SheetCrossing(const PartWithBvh& a, const PartWithBvh& b, double apart_within,
                QueryContext& work);

  [[nodiscard]] const std::vector<Stretch>& stretches() const;

  /// As sheet_crossing_depth(), of which the goal's `apart_within` is known here.
  [[nodiscard]] Depth depth(const DepthOptions& goal, QueryContext& work) const;
  /// Of some of the stretches, by number. Their list may lack some where there are very many: the
  /// upper bound says so.
  [[nodiscard]] Depth depth_along(std::span<const std::uint32_t> some, const DepthOptions& goal,
                                  QueryContext& work) const;

 private:
  struct Curves;
  std::shared_ptr<const Curves> curves_;
};

}  // namespace strake::geometry
