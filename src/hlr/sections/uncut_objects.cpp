// SPDX-License-Identifier: Apache-2.0
#include "hlr/sections/uncut_objects.hpp"

#include <algorithm>
#include <cstdint>

#include "strake/geometry/part.hpp"

namespace strake::hlr {
namespace {

/// What a plane leaves of an object, and what it cuts away.
struct PlaneSides {
  bool kept = false, away = false;
};

void add_body(const model::Scene& scene, const model::GridBody& body, const SectionPlane& plane,
              PlaneSides& sides) {
  const model::GridShape& shape = scene.shapes[body.grid_shape];
  if (shape.box.empty()) return;
  const geometry::Box3l box = body.box(shape);
  const bool all_away = plane.least(box) >= 0, all_kept = plane.greatest(box) < 0;
  sides.away = sides.away || all_away;
  sides.kept = sides.kept || all_kept;
  if (all_away || all_kept) return;
  for (const geometry::Part& part : shape.parts)
    for (const geometry::Vec3i& v : part.vertices) {
      if (sides.kept && sides.away) return;
      const bool below = plane.height(v.as<std::int64_t>() + body.origin) < 0;
      sides.kept = sides.kept || below;
      sides.away = sides.away || !below;
    }
}

PlaneSides sides_of(const model::Scene& scene, model::ObjectId object, const SectionPlane& plane) {
  PlaneSides sides;
  for (const model::GridBody& body : scene.bodies_of(object)) add_body(scene, body, plane, sides);
  return sides;
}

bool is_left_whole(const model::Scene& scene, model::ObjectId object,
                   std::span<const SectionPlane> planes) {
  bool cut = false;
  for (const SectionPlane& plane : planes) {
    const PlaneSides sides = sides_of(scene, object, plane);
    if (!sides.kept) return false;
    cut = cut || sides.away;
  }
  return cut;
}

}  // namespace

std::vector<bool> find_uncut(const model::Scene& scene, const std::vector<bool>& drawn,
                             const std::vector<bool>& to_solve,
                             std::span<const SectionPlane> planes) {
  if (planes.empty() || std::ranges::find(to_solve, true) == to_solve.end()) return {};
  std::vector<bool> uncut(to_solve.size());
  for (std::uint32_t o = 0; o < to_solve.size(); ++o)
    uncut[o] = to_solve[o] && drawn[o] && is_left_whole(scene, model::ObjectId{o}, planes);
  return uncut;
}

}  // namespace strake::hlr
