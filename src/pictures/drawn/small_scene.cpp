// SPDX-License-Identifier: Apache-2.0
#include "pictures/drawn/small_scene.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <variant>

#include "pictures/scenery/scene_index.hpp"

namespace strake::pictures {
namespace {

using geometry::Box3l;
using geometry::Part;
using geometry::PartEdge;
using geometry::Triangle;
using model::GridBody;
using model::GridShape;

/// Meshes of fewer triangles are taken whole: they cost little, and are solids as ever.
constexpr std::size_t kManyTriangles = 5000;

bool meets(const Part& part, const Triangle& t, const Box3l& box) {
  geometry::Box3i own = geometry::empty_box<std::int32_t>();
  for (const std::uint32_t v : t) own.include(part.vertices[v]);
  return own.as<std::int64_t>().meets(box);
}

/// An edge of a triangle, its lesser vertex first.
using EdgeOfTriangle = std::pair<std::array<std::uint32_t, 2>, std::uint32_t>;

void connect(Part& part) {
  std::vector<EdgeOfTriangle> sides;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(part.triangles[t][k], part.triangles[t][(k + 1) % 3]);
      sides.push_back({{low, high}, t});
    }
  std::ranges::sort(sides);
  std::vector<PartEdge> edges;
  std::vector<std::uint32_t> triangles;
  for (const auto& [ends, triangle] : sides) {
    if (edges.empty() || edges.back().v0 != ends[0] || edges.back().v1 != ends[1])
      edges.push_back({ends[0], ends[1], static_cast<std::uint32_t>(triangles.size())});
    triangles.push_back(triangle);
  }
  edges.push_back({0, 0, static_cast<std::uint32_t>(triangles.size())});
  part.edges = std::move(edges);
  part.edge_triangles = std::move(triangles);
}

/// Returns the triangles of a part that meet a box in its own coordinates, as a sheet.
Part cut_to(const Part& part, const Box3l& box) {
  Part out;
  out.kind = geometry::PartKind::sheet;
  out.flags = part.flags;
  out.flags.open = true;
  out.sag = part.sag;
  std::vector<std::uint32_t> number(part.vertices.size(), geometry::kNoIndex);
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> faces;
  for (std::size_t i = 0; i < part.triangles.size(); ++i) {
    Triangle t = part.triangles[i];
    if (!meets(part, t, box)) continue;
    for (std::uint32_t& v : t) {
      if (number[v] == geometry::kNoIndex) {
        number[v] = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(part.vertices[v]);
        out.box.include(part.vertices[v]);
      }
      v = number[v];
    }
    triangles.push_back(t);
    if (!part.faces.empty()) faces.push_back(part.faces[i]);
  }
  out.triangles = std::move(triangles);
  out.faces = std::move(faces);
  out.shell_count = 1;
  connect(out);
  return out;
}

class SmallSceneBuilder {
 public:
  SmallSceneBuilder(const model::Scene& scene, const Box3l& box) : from_(scene), box_(box) {
    out_.model = std::make_unique<model::Model>();
    out_.scene.sag_mm = from_.sag_mm;
    out_.scene.weld_mm = from_.weld_mm;
  }

  SmallScene build(const std::vector<std::uint32_t>& bodies) && {
    for (const std::uint32_t b : bodies) add(from_.bodies[b]);
    out_.scene.first_body.push_back(static_cast<std::uint32_t>(out_.scene.bodies.size()));
    out_.scene.model = out_.model.get();
    return std::move(out_);
  }

 private:
  void add(const GridBody& body) {
    if (out_.object.empty() || out_.object.back() != body.object) begin(body.object);
    model::Body placed = from_.model->bodies[body.body];
    GridBody mine = body;
    mine.grid_shape = shape(body);
    placed.shape = out_.scene.shapes[mine.grid_shape].shape;
    mine.body = static_cast<std::uint32_t>(out_.model->bodies.size());
    mine.object = model::ObjectId{static_cast<std::uint32_t>(out_.object.size() - 1)};
    ++out_.model->objects.back().body_count;
    out_.model->bodies.push_back(placed);
    out_.scene.bodies.push_back(mine);
  }

  void begin(model::ObjectId id) {
    out_.object.push_back(id);
    const model::Object& object = from_.model->object(id);
    model::Object mine;
    mine.id = object.id;
    mine.first_body = static_cast<std::uint32_t>(out_.model->bodies.size());
    out_.model->objects.push_back(std::move(mine));
    out_.scene.first_body.push_back(static_cast<std::uint32_t>(out_.scene.bodies.size()));
  }

  /// Returns the number of a body's shape in what is built.
  std::uint32_t shape(const GridBody& body) {
    const GridShape& given = from_.shapes[body.grid_shape];
    const Box3l box{box_.lo - body.origin, box_.hi - body.origin};
    const bool cut = std::ranges::any_of(
        given.parts, [&](const Part& part) { return part.triangles.size() >= kManyTriangles; });
    if (!cut)
      if (const auto known = whole_.find(body.grid_shape); known != whole_.end())
        return known->second;
    GridShape mine;
    mine.base = given.base;
    mine.box = given.box;
    for (const Part& part : given.parts)
      mine.parts.push_back(part.triangles.size() >= kManyTriangles ? cut_to(part, box) : part);
    mine.shape = model::ShapeId{static_cast<std::uint32_t>(out_.model->shapes.size())};
    out_.model->shapes.push_back(source(given.shape));
    const auto number = static_cast<std::uint32_t>(out_.scene.shapes.size());
    out_.scene.shapes.push_back(std::move(mine));
    if (!cut) whole_.emplace(body.grid_shape, number);
    return number;
  }

  /// Only primitives are made anew for a view: of meshes the kind is enough.
  [[nodiscard]] model::Shape source(model::ShapeId id) const {
    const model::Shape& shape = from_.model->shapes[index(id)];
    if (const auto* primitive = std::get_if<geometry::Primitive>(&shape)) return *primitive;
    return std::holds_alternative<geometry::Polylines>(shape)
               ? model::Shape{geometry::Polylines{}}
               : model::Shape{geometry::TriangleMesh{}};
  }

  const model::Scene& from_;
  Box3l box_;
  SmallScene out_;
  std::map<std::uint32_t, std::uint32_t> whole_;
};

}  // namespace

SmallScene small_scene(const Scenery& scenery, const Box3l& box) {
  return SmallSceneBuilder(scenery.scene(), box).build(scenery.index().bodies_in(box));
}

}  // namespace strake::pictures
