// SPDX-License-Identifier: Apache-2.0
#include "peers/peer_scene.hpp"

#include <cstdint>
#include <utility>

#include "strake/geometry/grid.hpp"

namespace strake::bench {

std::vector<PeerObject> peer_objects(const model::Scene& scene) {
  std::vector<PeerObject> objects(scene.model->objects.size());
  for (const model::GridBody& body : scene.bodies) {
    PeerObject& o = objects[model::index(body.object)];
    for (const geometry::Part& part : scene.shapes[body.grid_shape].parts) {
      const auto base = static_cast<std::uint32_t>(o.points.size());
      if (part.kind == geometry::PartKind::wire) continue;
      for (const geometry::Vec3i& v : part.vertices) {
        o.points.push_back(to_mm(body.origin + v.as<std::int64_t>()));
        o.box.include(o.points.back());
      }
      for (const geometry::Triangle& t : part.triangles)
        o.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    }
  }
  return objects;
}

model::Model as_meshes(const model::Model& from, const std::vector<PeerObject>& objects) {
  model::Model meshes;
  meshes.files = from.files;
  meshes.groups = from.groups;
  meshes.group_attributes = from.group_attributes;
  meshes.objects = from.objects;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    model::Object& o = meshes.objects[i];
    o.first_body = static_cast<std::uint32_t>(meshes.bodies.size());
    o.body_count = objects[i].triangles.empty() ? 0 : 1;
    if (o.body_count == 0) continue;
    model::Body body;
    body.shape = model::ShapeId{static_cast<std::uint32_t>(meshes.shapes.size())};
    // About the object's own corner, as a placement in a file would have it.
    const geometry::Vec3d corner = objects[i].box.lo;
    body.placement.translation = corner;
    geometry::TriangleMesh mesh;
    for (const geometry::Vec3d& p : objects[i].points) mesh.vertices.push_back(p - corner);
    mesh.triangles = objects[i].triangles;
    meshes.shapes.emplace_back(std::move(mesh));
    meshes.bodies.push_back(body);
  }
  return meshes;
}

}  // namespace strake::bench
