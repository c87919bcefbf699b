// SPDX-License-Identifier: Apache-2.0
// Names of objects and planes in diagnostics, and reports on the sections and the eye of a view.
#include "hlr/prepare/view_diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "strake/geometry/grid.hpp"
#include "strake/geometry/inside.hpp"
#include "strake/parallel/collect.hpp"

namespace strake::hlr {

std::string object_text(const model::Model& model, model::ObjectId id) {
  const model::Object& object = model.object(id);
  const std::string& name = object.name.empty() ? object.id : object.name;
  return object.file < model.files.size() && !model.files[object.file].label.empty()
             ? fmt::format("{}: {}", model.files[object.file].label, name)
             : name;
}

namespace {

/// "1,-2,0 > 1500 mm": a plane by its normal and its distance from the origin along it.
std::string name_of(const SectionPlane& plane) {
  const auto& n = plane.normal;
  const geometry::Vec3d d = n.as<double>();
  const double distance = static_cast<double>(plane.offset) / std::sqrt(dot(d, d));
  return fmt::format("{},{},{} > {:.3f} mm", n.x, n.y, n.z, distance * geometry::kMmPerGrid);
}

void report_unmet_planes(const model::Scene& scene, const std::vector<bool>& drawn,
                         std::span<const SectionPlane> planes, Diagnostics& diagnostics) {
  for (const SectionPlane& plane : planes) {
    bool kept = false, away = false;
    for (const model::GridBody& body : scene.bodies) {
      const model::GridShape& shape = scene.shapes[body.grid_shape];
      if (!drawn[model::index(body.object)] || shape.box.empty()) continue;
      const geometry::Box3l box = body.box(shape);
      kept = kept || plane.least(box) < 0;
      away = away || plane.greatest(box) >= 0;
      if (kept && away) break;
    }
    if (kept == away) continue;
    diagnostics.add(Severity::warning, "section-misses",
                    kept ? "the section plane misses what is drawn: it cuts away nothing"
                         : "the section plane misses what is drawn: it cuts away everything",
                    name_of(plane));
  }
}

}  // namespace

Result<Diagnostics> report_sections(const model::Scene& scene, const std::vector<bool>& drawn,
                                    const SectionedShapes& sectioned,
                                    std::span<const SectionPlane> planes,
                                    const parallel::Context& context) {
  Diagnostics diagnostics;
  report_unmet_planes(scene, drawn, planes, diagnostics);
  if (planes.empty() || scene.first_body.empty()) return diagnostics;
  struct NotClosed {
    std::uint32_t object = 0;
    std::uint64_t open_ends = 0, not_filled = 0;
  };
  // Only shares the work out.
  constexpr std::size_t kGrain = 1024;
  const auto not_closed = parallel::collect<NotClosed>(
      context, {.name = "view: open sections", .n = scene.first_body.size() - 1, .grain = kGrain},
      [&](std::size_t o, std::vector<NotClosed>& out) {
        NotClosed object{.object = static_cast<std::uint32_t>(o)};
        for (std::uint32_t b = scene.first_body[o]; b < scene.first_body[o + 1]; ++b)
          if (const ShapeCut* cut = sectioned.all[sectioned.of[b]].cut.get()) {
            object.open_ends += cut->open_ends;
            object.not_filled += cut->not_filled;
          }
        if (object.open_ends > 0 || object.not_filled > 0) out.push_back(object);
      });
  if (!not_closed) return not_closed.error();
  for (const auto& [o, open_ends, not_filled] : *not_closed) {
    const auto add = [&, object = o](std::string_view code, const std::string& message) {
      diagnostics.add(Severity::warning, code, message,
                      object_text(*scene.model, model::ObjectId{object}));
    };
    if (open_ends > 0)
      add("section-open",
          fmt::format("a surface that is not closed is cut: its outline has {} loose ends and is "
                      "not hatched",
                      open_ends));
    if (not_filled > 0)
      add("section-not-filled",
          fmt::format("{} of its sections could not be closed: not hatched, and hiding nothing",
                      not_filled));
  }
  return diagnostics;
}

namespace {

using geometry::PointSide;

PointSide side_of(const ViewJob& job, std::uint32_t body) {
  const geometry::Vec3l eye = job.view.perspective->eye - job.scene->bodies[body].origin;
  const model::GridShape& shape = job.sectioned_shape_of(body).shape();
  PointSide side = PointSide::outside;
  if (shape.box.empty() || !shape.box.as<std::int64_t>().contains({eye, eye})) return side;
  for (const geometry::Part& part : shape.parts)
    if (part.kind != geometry::PartKind::wire)
      side = std::max(side, geometry::side_of_polyhedron(part, {eye, 1}));
  return side;
}

}  // namespace

Result<Diagnostics> report_eye(const ViewJob& job, const parallel::Context& context) {
  Diagnostics diagnostics;
  if (!job.view.perspective) return diagnostics;
  struct Met {
    std::uint32_t body = 0;
    PointSide side = PointSide::outside;
  };
  // Only shares the work out.
  constexpr std::size_t kPerBlock = 1024;
  const auto met = parallel::collect<Met>(
      context, {.name = "view: eye", .n = job.scene->bodies.size(), .grain = kPerBlock},
      [&](std::size_t index, std::vector<Met>& out) {
        const auto b = static_cast<std::uint32_t>(index);
        const PointSide side = job.opaque[b] ? side_of(job, b) : PointSide::outside;
        if (side != PointSide::outside) out.push_back({b, side});
      });
  if (!met) return met.error();
  for (const auto& [b, side] : *met) {
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
