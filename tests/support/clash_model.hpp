// SPDX-License-Identifier: Apache-2.0
// Models of boxes and primitives made by hand, and what the clash engine says about them.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "strake/clash/clash.hpp"
#include "strake/model/scene.hpp"
#include "support/meshes.hpp"

namespace strake::test {

struct ClashModel {
  model::Model model;

  ClashModel() { model.files.push_back({"t.obj", "OBJ", "mm", "z", 1, 0}); }

  /// Starts an object; bodies added after it belong to it.
  ClashModel& object(const std::string& id) {
    model::Object o;
    o.id = o.name = id;
    o.first_body = static_cast<std::uint32_t>(model.bodies.size());
    model.objects.push_back(o);
    return *this;
  }
  ClashModel& body(model::Shape shape, const geometry::Placement& placement = {}) {
    model.shapes.push_back(std::move(shape));
    return again(placement);
  }
  /// Another body of the shape made last.
  ClashModel& again(const geometry::Placement& placement) {
    return body_of(model.shapes.size() - 1, placement);
  }
  /// Another body of shape number `shape`.
  ClashModel& body_of(std::size_t shape, const geometry::Placement& placement) {
    model::Body b;
    b.shape = model::ShapeId{static_cast<std::uint32_t>(shape)};
    b.placement = placement;
    model.bodies.push_back(b);
    ++model.objects.back().body_count;
    return *this;
  }
  ClashModel& box(const std::string& id, const geometry::Vec3d& lo, const geometry::Vec3d& hi,
                  bool inside_out = false) {
    return object(id).body(box_mesh(lo, hi, inside_out));
  }

  [[nodiscard]] clash::Report detect(const clash::Options& options = {},
                                     const parallel::Context& context = {}) const {
    const model::Scene scene = make_scene(model, clash::scene_options(options), context).value();
    return clash::detect(scene, clash::one_set(scene), options, context).value();
  }
};

}  // namespace strake::test
