// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "strake/geometry/vec.hpp"

namespace strake::page {

/// Places of a model, by which boxes are found that come within a reach of any of them.
class NearPoints {
 public:
  /// Points that are not finite, or that the grid does not reach, are left out; `reach_mm` is more
  /// than 0.
  NearPoints(std::span<const geometry::Vec3d> points_mm, double reach_mm);

  /// Whether a box, grid units, comes within the reach of a point along each axis.
  [[nodiscard]] bool is_near(const geometry::Box3l& box) const;

 private:
  using Cell = geometry::Vec3l;
  [[nodiscard]] Cell cell_of(const geometry::Vec3l& point) const;
  [[nodiscard]] bool holds_near(std::pair<std::size_t, std::size_t> run,
                                const geometry::Box3l& reached) const;

  std::int64_t reach_;
  std::vector<geometry::Vec3l> points_;                        ///< by cell
  std::map<Cell, std::pair<std::size_t, std::size_t>> cells_;  ///< ranges of `points_`
};

}  // namespace strake::page
