// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pictures/viewpoint.hpp"
#include "strake/model/scene.hpp"

namespace strake::pictures {

/// The part of a scene that a picture shows, as a scene of its own, so that drawing it costs what
/// it holds and not what the model holds.
struct SmallScene {
  std::unique_ptr<model::Model> model;  ///< objects and bodies of the scene
  model::Scene scene;
  std::vector<model::ObjectId> object;  ///< what each object of it is in the model
};

/// Returns what meets a box, grid units. Of large meshes only triangles that meet it are there, so
/// that they end outside it, and are no solids then.
[[nodiscard]] SmallScene small_scene(const Scenery& scenery, const geometry::Box3l& box);

}  // namespace strake::pictures
