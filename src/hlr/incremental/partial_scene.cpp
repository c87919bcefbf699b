// SPDX-License-Identifier: Apache-2.0
#include "hlr/incremental/partial_scene.hpp"

namespace strake::hlr {

model::ViewTessellation PartialScene::plan(const model::ViewTessellation& whole) const {
  model::ViewTessellation own{.finer = {}, .any = whole.any};
  if (whole.finer.empty()) return own;
  own.finer.reserve(shapes.size());
  for (const std::uint32_t shape : shapes) own.finer.push_back(whole.finer[shape]);
  return own;
}

PartialScene scene_of(const model::Scene& scene, const std::vector<bool>& wanted) {
  constexpr std::uint32_t kNone = 0xffffffffU;
  PartialScene part;
  part.scene.model = scene.model;
  part.scene.sag_mm = scene.sag_mm;
  part.scene.weld_mm = scene.weld_mm;
  part.scene.first_body.reserve(scene.first_body.size());
  std::vector<std::uint32_t> number(scene.shapes.size(), kNone);
  for (std::size_t object = 0; object < wanted.size(); ++object) {
    part.scene.first_body.push_back(static_cast<std::uint32_t>(part.scene.bodies.size()));
    if (!wanted[object]) continue;
    for (std::uint32_t b = scene.first_body[object]; b < scene.first_body[object + 1]; ++b) {
      model::GridBody body = scene.bodies[b];
      std::uint32_t& shape = number[body.grid_shape];
      if (shape == kNone) {
        shape = static_cast<std::uint32_t>(part.shapes.size());
        part.shapes.push_back(body.grid_shape);
        part.scene.shapes.push_back(scene.shapes[body.grid_shape]);
      }
      body.grid_shape = shape;
      part.scene.bodies.push_back(body);
    }
  }
  part.scene.first_body.push_back(static_cast<std::uint32_t>(part.scene.bodies.size()));
  return part;
}

}  // namespace strake::hlr
