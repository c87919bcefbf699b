// SPDX-License-Identifier: Apache-2.0
#include "pictures/scenery/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pictures/scenery/scene_index.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::pictures {
namespace {

using geometry::Box3d;
using geometry::Box3i;
using geometry::Box3l;
using geometry::Vec3d;
using geometry::Vec3l;

constexpr std::uint8_t kOpaque = 255;

/// So many triangles have one box: fewer are looked at in vain where there are fewer, and more
/// boxes.
constexpr std::uint32_t kLongestRun = 16;

/// Adds the triangles of a part that meet a box; both are on the grid, the triangles are reckoned
/// from `point`.
void add_part(const geometry::Part& part, const Vec3l& origin, const Vec3l& point, Role role,
              const Box3l& box, std::vector<NearTriangle>& out) {
  const Box3l common = box.moved(-origin).common(part.box.as<std::int64_t>());
  if (part.box.empty() || common.empty()) return;
  const Box3i near = common.as<std::int32_t>();
  const Vec3l offset = origin - point;
  const auto mm = [&](std::uint32_t vertex) {
    return geometry::to_mm(part.vertices[vertex].as<std::int64_t>() + offset);
  };
  for (const geometry::Triangle& t : part.triangles) {
    Box3i own = geometry::empty_box<std::int32_t>();
    for (const std::uint32_t vertex : t) own.include(part.vertices[vertex]);
    if (own.meets(near))
      out.push_back({{mm(t[0]), mm(t[1]), mm(t[2])}, role, part.kind == geometry::PartKind::solid});
  }
}

}  // namespace

NearTriangles::NearTriangles(std::vector<NearTriangle> triangles)
    : triangles_(std::move(triangles)) {
  const auto count = static_cast<std::uint32_t>(triangles_.size());
  bool was_own = false;
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool own = triangles_[i].role != Role::other;
    std::vector<TriangleRun>& runs = own ? own_ : others_;
    if (i == 0 || own != was_own || i - first == kLongestRun) {
      first = i;
      runs.push_back({i, i});
    }
    was_own = own;
    runs.back().end = i + 1;
    for (const Vec3d& p : triangles_[i].at) runs.back().box.include(p);
  }
}

std::vector<NearTriangle> triangles_near(const Scenery& scenery, const Roles& roles,
                                         const Vec3l& point, double half_mm) {
  const auto half = static_cast<std::int64_t>(std::ceil(half_mm * geometry::kGridPerMm));
  const Box3l box = Box3l{point, point}.inflated(half);
  const model::Scene& scene = scenery.scene();
  std::vector<NearTriangle> out;
  for (const std::uint32_t b : scenery.index().bodies_in(box)) {
    const model::GridBody& body = scene.bodies[b];
    const Role role = roles.of(body.object);
    if (role == Role::other && scene.model->bodies[body.body].color.alpha < kOpaque) continue;
    for (const geometry::Part& part : scene.shapes[body.grid_shape].parts)
      add_part(part, body.origin, point, role, box, out);
  }
  return out;
}

}  // namespace strake::pictures
