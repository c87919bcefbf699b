// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/plane_cut.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"

namespace strake::hlr {

/// Lines of a hatch on a plane: all that run one way at one distance, and of these the one that
/// goes through the model's origin. What is hatched in one pattern so fits together.
///
/// Which line meets which rim is decided in integers; the direction is rounded to 20 bits.
class HatchGrid {
 public:
  /// `angle_deg` from the horizontal of the view, seen square to the plane; the spacing in grid
  /// units. The plane is not seen edge-on, the spacing at least one.
  HatchGrid(const geometry::Vec3l& normal, const View& view, double angle_deg, double spacing);

  /// What lies within an oriented rim (geometry::rim_of_caps) on a plane, both in the coordinates
  /// of a body at `origin`: ascending, ends rounded to the grid.
  [[nodiscard]] std::vector<geometry::Segment> within(std::span<const geometry::Segment> rim,
                                                      const geometry::CutPlane& plane,
                                                      const geometry::Vec3l& origin) const;

 private:
  [[nodiscard]] std::int64_t value(const geometry::Vec3l& p) const {
    return along_u_ * p[axes_.u] + along_v_ * p[axes_.v];
  }

  geometry::PlaneAxes axes_;
  std::int64_t along_u_ = 0, along_v_ = 0;  ///< a line is where u and v times these is constant
  std::int64_t step_ = 1;                   ///< of that constant from line to line
};

}  // namespace strake::hlr
