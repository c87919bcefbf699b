// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/plane_section/plane_section.hpp"
#include "hlr/prepare/view_job.hpp"
#include "hlr/sections/section_planes.hpp"
#include "hlr/sections/sectioned_shapes.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// The hatch of each object, both numbers chosen where they were not given: the spacing tells
/// colours apart and the angle neighbours, as far as the few usual angles go. Objects are
/// neighbours where outlines of their sections meet within `contact` (by body). `usual_mm`: the
/// usual spacing. Objects that are not cut keep what was given. Errors: cancelled.
[[nodiscard]] Result<std::vector<Hatch>> choose_hatches(const model::Scene& scene,
                                                        const SectionedShapes& seen,
                                                        const std::vector<std::int64_t>& contact,
                                                        const std::vector<Hatch>& given,
                                                        double usual_mm,
                                                        const parallel::Context& context);

/// Lines of a hatch on a plane: all that run one way at one distance, and of these the one that
/// goes through the model's origin. What is hatched in one pattern so fits together.
///
/// Which line meets which rim is decided in integers; the direction is rounded to 20 bits.
class HatchGrid {
 public:
  /// `angle_deg` from the horizontal of the view, seen square to the plane; the spacing in grid
  /// units. The plane is not seen edge-on, the spacing at least one.
  HatchGrid(const geometry::Vec3l& normal, const View& view, double angle_deg, double spacing);

  /// What lies within an oriented rim (geometry::cap_boundary) on a plane, both in the coordinates
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

/// Hatch lines on the caps that look towards the viewer, by body. Errors: a spacing or an angle
/// that makes no sense (usage), cancelled.
[[nodiscard]] Result<std::vector<Line>> hatch_lines(const ViewJob& job,
                                                    std::span<const SectionPlane> planes,
                                                    const parallel::Context& context);

}  // namespace strake::hlr
