// SPDX-License-Identifier: Apache-2.0
#include "hlr/eye_report.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "hlr/object_text.hpp"
#include "strake/geometry/inside.hpp"

namespace strake::hlr {
namespace {

using geometry::PointSide;

PointSide side_of(const Job& job, std::uint32_t body) {
  const geometry::Vec3l eye = job.view.perspective->eye - job.scene->bodies[body].origin;
  const model::GridShape& shape = job.seen_of(body).shape();
  PointSide side = PointSide::outside;
  if (shape.box.empty() || !shape.box.as<std::int64_t>().contains({eye, eye})) return side;
  for (const geometry::Part& part : shape.parts)
    if (part.kind != geometry::PartKind::wire)
      side = std::max(side, geometry::side_of_polyhedron(part, {eye, 1}));
  return side;
}

}  // namespace

Diagnostics report_eye(const Job& job) {
  Diagnostics diagnostics;
  if (!job.view.perspective) return diagnostics;
  for (std::uint32_t b = 0; b < job.scene->bodies.size(); ++b) {
    const PointSide side = job.opaque[b] ? side_of(job, b) : PointSide::outside;
    if (side == PointSide::outside) continue;
    std::string where = object_text(*job.scene->model, job.scene->bodies[b].object);
    if (side == PointSide::inside)
      diagnostics.add(Severity::warning, "eye-in-solid",
                      "the eye lies inside a solid, which hides all that is outside it",
                      std::move(where));
    else
      diagnostics.add(Severity::warning, "eye-on-surface",
                      "the eye lies on a surface, which it does not see", std::move(where));
  }
  return diagnostics;
}

}  // namespace strake::hlr
