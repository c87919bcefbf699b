// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "strake/model/model.hpp"

namespace strake::test {

/// A box of triangles with one corner at the origin, outward.
[[nodiscard]] inline geometry::TriangleMesh box_mesh(double x, double y, double z) {
  geometry::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(
        {(i & 1) != 0 ? x : 0.0, (i & 2) != 0 ? y : 0.0, (i & 4) != 0 ? z : 0.0});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

inline model::ShapeId add_shape(model::Model& model, model::Shape shape) {
  model.shapes.push_back(std::move(shape));
  return static_cast<model::ShapeId>(model.shapes.size() - 1);
}

inline model::GroupId add_group(model::Model& model, std::string name,
                                model::GroupId parent = model::GroupId::none) {
  model.groups.push_back({std::move(name), parent});
  return static_cast<model::GroupId>(model.groups.size() - 1);
}

/// Appends an object without bodies; bodies are added right behind it.
inline model::Object& add_object(model::Model& model, const std::string& id, std::string name,
                                 model::GroupId parent = model::GroupId::none) {
  model::Object object;
  object.id = id;
  object.name = std::move(name);
  object.parent = parent;
  object.first_body = static_cast<std::uint32_t>(model.bodies.size());
  return model.objects.emplace_back(std::move(object));
}

inline void add_body(model::Model& model, model::ShapeId shape,
                     const geometry::Placement& placement, const model::Color& color = {}) {
  model.bodies.push_back({shape, 0, placement, color, model::Category::physical});
  ++model.objects.back().body_count;
}

/// A quarter turn about z and a shift.
[[nodiscard]] inline geometry::Placement quarter_turn(const geometry::Vec3d& shift) {
  return {{{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}}, shift};
}

/// Groups two deep, a shape shared by three objects, an object of two bodies, a transparent one,
/// a polyline, attributes, and names that need escaping.
[[nodiscard]] inline model::Model sample_model() {
  model::Model model;
  model.files.push_back({"sample", "made", "mm (stated)", "z", 0, 0});
  const model::ShapeId box = add_shape(model, box_mesh(1000, 500, 250));
  geometry::Polylines axis;
  axis.points = {{0, 0, 0}, {100, 0, 0}, {100, 200, 0}, {7, 8, 9}, {8, 8, 9}};
  axis.first = {0, 3, 5};
  const model::ShapeId line = add_shape(model, axis);
  const model::GroupId deck = add_group(model, "Deck \"A\"");
  const model::GroupId frame = add_group(model, "Frame 7/8", deck);

  add_object(model, "one", "Box Ä\n", deck).attributes = {{"weight", "12 kg"}, {"weight", "13 kg"}};
  add_body(model, box, {{}, {10, 20, 30}}, {255, 0, 0, 255});
  add_object(model, "two", "turned", frame);
  add_body(model, box, quarter_turn({5000, 0, 0}), {255, 0, 0, 255});
  add_object(model, "three", "pair");
  add_body(model, box, quarter_turn({0, 7000, 0}), {1, 2, 3, 255});
  add_body(model, box, {{}, {0, 7000, 1000}}, {1, 2, 3, 255});
  add_object(model, "four", "glass", frame);
  add_body(model, box, {{}, {0, 0, 9000.5}}, {0, 0, 255, 64});
  add_object(model, "five", "axis");
  add_body(model, line, {{}, {1, 2, 3}}, {9, 9, 9, 255});
  return model;
}

}  // namespace strake::test
