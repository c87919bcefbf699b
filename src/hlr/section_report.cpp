// SPDX-License-Identifier: Apache-2.0
#include "hlr/section_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "hlr/object_text.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::hlr {
namespace {

/// "1,-2,0 > 1500 mm": a plane by its normal and its distance from the origin along it.
std::string name_of(const SectionPlane& plane) {
  const auto& n = plane.normal;
  const geometry::Vec3d d = n.as<double>();
  const double distance = static_cast<double>(plane.offset) / std::sqrt(dot(d, d));
  return fmt::format("{},{},{} > {:.3f} mm", n.x, n.y, n.z, distance * geometry::kMmPerGrid);
}

void report_misses(const model::Scene& scene, const std::vector<bool>& drawn,
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

Diagnostics report_sections(const model::Scene& scene, const std::vector<bool>& drawn,
                            const SeenShapes& seen, std::span<const SectionPlane> planes) {
  Diagnostics diagnostics;
  report_misses(scene, drawn, planes, diagnostics);
  if (planes.empty()) return diagnostics;
  for (std::uint32_t o = 0; o + 1 < scene.first_body.size(); ++o) {
    std::uint64_t open_ends = 0, not_filled = 0;
    for (std::uint32_t b = scene.first_body[o]; b < scene.first_body[o + 1]; ++b)
      if (const ShapeCut* cut = seen.all[seen.of[b]].cut.get()) {
        open_ends += cut->open_ends;
        not_filled += cut->not_filled;
      }
    const auto add = [&](std::string_view code, const std::string& message) {
      diagnostics.add(Severity::warning, code, message,
                      object_text(*scene.model, model::ObjectId{o}));
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

}  // namespace strake::hlr
