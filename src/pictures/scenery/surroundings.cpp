// SPDX-License-Identifier: Apache-2.0
#include "pictures/scenery/surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "pictures/scenery/scene_index.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::pictures {
namespace {

using geometry::Box3d;
using geometry::Box3l;
using geometry::Vec3d;
using geometry::Vec3l;

constexpr std::uint8_t kOpaque = 255;

void add_part(const geometry::Part& part, const Vec3l& offset, Role role, const Box3d& box,
              std::vector<NearTriangle>& out) {
  const auto mm = [&](std::uint32_t vertex) {
    return geometry::to_mm(part.vertices[vertex].as<std::int64_t>() + offset);
  };
  for (const geometry::Triangle& t : part.triangles) {
    const std::array<Vec3d, 3> at{mm(t[0]), mm(t[1]), mm(t[2])};
    Box3d own = geometry::empty_box<double>();
    for (const Vec3d& p : at) own.include(p);
    if (own.meets(box)) out.push_back({at, role, part.kind == geometry::PartKind::solid});
  }
}

}  // namespace

std::vector<NearTriangle> triangles_near(const Scenery& scenery, const Roles& roles,
                                         const Vec3l& point, double half_mm) {
  const auto half = static_cast<std::int64_t>(std::ceil(half_mm * geometry::kGridPerMm));
  const Box3l box = Box3l{point, point}.inflated(half);
  const Box3d around{{-half_mm, -half_mm, -half_mm}, {half_mm, half_mm, half_mm}};
  const model::Scene& scene = scenery.scene();
  std::vector<NearTriangle> out;
  for (const std::uint32_t b : scenery.index().bodies_in(box)) {
    const model::GridBody& body = scene.bodies[b];
    const Role role = roles.of(body.object);
    if (role == Role::other && scene.model->bodies[body.body].color.alpha < kOpaque) continue;
    for (const geometry::Part& part : scene.shapes[body.grid_shape].parts)
      add_part(part, body.origin - point, role, around, out);
  }
  return out;
}

}  // namespace strake::pictures
