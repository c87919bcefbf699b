// SPDX-License-Identifier: Apache-2.0
// Hatches of sections: the choice of angle and spacing, and the clipped hatch lines.
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

/// Returns the hatch of each object, with angle and spacing chosen where they were not given: the
/// spacing distinguishes colours and the angle neighbours, as far as the few usual angles go.
/// Objects are neighbours where outlines of their sections meet within `contact` (by body).
/// `usual_mm`: the usual spacing. Objects that are not cut keep what was given. Errors: cancelled.
[[nodiscard]] Result<std::vector<Hatch>> choose_hatches(const model::Scene& scene,
                                                        const SectionedShapes& sectioned,
                                                        const std::vector<std::int64_t>& contact,
                                                        const std::vector<Hatch>& given,
                                                        double usual_mm,
                                                        const parallel::Context& context);

/// The hatch lines of one pattern on a plane: parallels at one distance, one of which goes through
/// the model's origin, so that areas of one pattern fit together.
///
/// The lines that meet a rim are found in integers; the direction is rounded to 20 bits.
class HatchGrid {
 public:
  /// `angle_deg` is measured from the horizontal of the view, seen square to the plane; the spacing
  /// is in grid units, at least one. The plane must not be seen edge-on.
  HatchGrid(const geometry::Vec3l& normal, const View& view, double angle_deg, double spacing);

  /// Returns the hatch lines within an oriented rim (geometry::cap_boundary) on a plane, both in
  /// the coordinates of a body at `origin`: ascending, with ends rounded to the grid.
  [[nodiscard]] std::vector<geometry::Segment> within(std::span<const geometry::Segment> rim,
                                                      const geometry::CutPlane& plane,
                                                      const geometry::Vec3l& origin) const;

 private:
  [[nodiscard]] std::int64_t value(const geometry::Vec3l& p) const {
    return along_u_ * p[axes_.u] + along_v_ * p[axes_.v];
  }

  geometry::PlaneAxes axes_;
  std::int64_t along_u_ = 0, along_v_ = 0;  ///< along_u_·u + along_v_·v is constant on a line
  std::int64_t step_ = 1;                   ///< difference of that constant from line to line
};

/// Returns the hatch of each object of a job, see choose_hatches(); nothing where none is wanted.
/// Errors: a spacing or an angle that makes no sense (usage), cancelled.
[[nodiscard]] Result<std::vector<Hatch>> choose_hatches(const ViewJob& job,
                                                        std::span<const SectionPlane> planes,
                                                        const parallel::Context& context);

/// Returns the hatch lines on the caps that look towards the viewer, by body, in the job's
/// hatches. Errors: cancelled.
[[nodiscard]] Result<std::vector<Line>> hatch_lines(const ViewJob& job,
                                                    std::span<const SectionPlane> planes,
                                                    const parallel::Context& context);

}  // namespace strake::hlr
