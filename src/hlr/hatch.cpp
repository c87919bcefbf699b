// SPDX-License-Identifier: Apache-2.0
#include "hlr/hatch.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "hlr/hatch_grid.hpp"
#include "hlr/hatch_patterns.hpp"
#include "hlr/job.hpp"
#include "strake/geometry/grid.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::hlr {
namespace {

using geometry::Box3l;
using geometry::Vec3l;

/// The usual spacing is such a share of the drawing's largest side: 2.5 mm or so of paper.
constexpr double kUsualShare = 150;
/// Finer than this share of the drawing is a black face, and more lines than anybody wants.
constexpr double kFinestShare = 20000;
constexpr double kFinestMm = 0.01;

/// The largest side of what is left, mm.
double largest_side(const Job& job) {
  const model::Scene& scene = *job.scene;
  Box3l box = geometry::empty_box<std::int64_t>();
  for (std::uint32_t b = 0; b < scene.bodies.size(); ++b) {
    const model::GridShape& shape = scene.shapes[scene.bodies[b].grid_shape];
    if (!job.drawn[model::index(scene.bodies[b].object)] || job.seen_of(b).away) continue;
    if (!shape.box.empty()) box.include(scene.bodies[b].box(shape));
  }
  if (job.view.limits) box = box.common(*job.view.limits);
  if (box.empty()) return 0;
  const Vec3l size = box.hi - box.lo;
  return static_cast<double>(std::max({size.x, size.y, size.z})) * geometry::kMmPerGrid;
}

/// The first of 1, 2, 5, 10 … that is no less.
double usual_number(double least) {
  double decade = kFinestMm;
  for (;; decade *= 10)
    for (const double step : {1.0, 2.0, 5.0})
      if (decade * step >= least) return decade * step;
}

Status check(const Job& job, double usual_mm, double side_mm) {
  const auto fault = [](const char* what, const char* mend) {
    return Error{ErrorCode::usage, what, "hatch", mend};
  };
  const double finest = std::max(side_mm / kFinestShare, kFinestMm);
  const auto makes_sense = [&](double spacing) { return spacing >= finest && spacing < 1e9; };
  if (!makes_sense(usual_mm))
    return fault("the distance of hatch lines is too small for the drawing, or too large",
                 "leave it out to have it chosen");
  for (const Hatch& hatch : job.options.hatches) {
    if (!(hatch.spacing_mm <= 0) && !makes_sense(hatch.spacing_mm))
      return fault("the distance of hatch lines is too small for the drawing, or too large",
                   "leave it out to have it chosen");
    if (!(hatch.angle_deg <= 180))
      return fault("the angle of hatch lines is not between 0 and 180 degrees",
                   "45 is the usual angle");
  }
  if (!job.options.hatches.empty() && job.options.hatches.size() != job.drawn.size())
    return Error{ErrorCode::internal, "the hatches and the model differ in size", "hatch", ""};
  return {};
}

bool is_towards(const Job& job, const SectionPlane& plane) {
  if (job.view.perspective) return plane.height(job.view.perspective->eye) > 0;
  return along({plane.normal.x, plane.normal.y, plane.normal.z}, job.direction()) > 0;
}

/// The hatch of one body.
void add_body(const Job& job, std::span<const SectionPlane> planes, std::uint32_t b,
              const Hatch& hatch, std::vector<Line>& out) {
  const SeenShape& seen = job.seen_of(b);
  if (!seen.cut || hatch.spacing_mm == 0) return;
  const Vec3l origin = job.scene->bodies[b].origin;
  for (std::size_t p = 0; p < seen.planes.size(); ++p) {
    const SectionPlane& plane = planes[seen.numbers[p]];
    if (!is_towards(job, plane) || seen.cut->rims[p].empty()) continue;
    const HatchGrid grid(plane.normal, job.view, hatch.angle_deg,
                         hatch.spacing_mm * geometry::kGridPerMm);
    for (const geometry::Segment& line : grid.within(seen.cut->rims[p], seen.planes[p], origin))
      out.push_back({line[0] + origin, line[1] + origin, b, b, EdgeKind::hatch, false});
  }
}

}  // namespace

Result<std::vector<Line>> hatch_lines(const Job& job, std::span<const SectionPlane> planes,
                                      const parallel::Context& context) {
  const double side_mm = largest_side(job);
  if (planes.empty() || job.options.hatch_spacing_mm == 0 || side_mm == 0)
    return std::vector<Line>{};
  const double usual_mm = job.options.hatch_spacing_mm < 0 ? usual_number(side_mm / kUsualShare)
                                                           : job.options.hatch_spacing_mm;
  if (const Status status = check(job, usual_mm, side_mm); !status) return status.error();
  const auto hatches =
      choose_hatches(*job.scene, job.seen, job.contact, job.options.hatches, usual_mm, context);
  if (!hatches) return hatches.error();
  return parallel::collect<Line>(
      context, {.name = "sections: hatch", .n = job.scene->bodies.size(), .grain = 16},
      [&](std::size_t b, std::vector<Line>& out) {
        const model::ObjectId object = job.scene->bodies[b].object;
        add_body(job, planes, static_cast<std::uint32_t>(b), (*hatches)[model::index(object)], out);
      });
}

}  // namespace strake::hlr
