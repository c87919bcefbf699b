// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/placed_model.hpp"

#include <utility>

#include "strake/parallel/team.hpp"

namespace strake::cli {

Result<PlacedModel> place_model(model::Model model, const model::SceneOptions& options,
                                const std::stop_token& stop) {
  parallel::Team team(parallel::default_workers());
  PlacedModel placed;
  placed.model = std::make_unique<const model::Model>(std::move(model));
  Result<model::Scene> scene =
      model::make_scene(*placed.model, options, {.team = &team, .stop = stop});
  if (!scene) return scene.error();
  placed.scene = std::move(*scene);
  for (const model::GridBody& body : placed.scene.bodies) {
    const model::GridShape& shape = placed.scene.shapes[body.grid_shape];
    placed.box.include(body.box(shape));
    for (const geometry::Part& part : shape.parts) placed.triangles += part.triangles.size();
  }
  return placed;
}

Result<PlacedModel> place_ship(const generate::ShipOptions& ship,
                               const model::SceneOptions& options, const std::stop_token& stop) {
  parallel::Team team(parallel::default_workers());
  Result<generate::Ship> made = generate::generate_ship(ship, {.team = &team, .stop = stop});
  if (!made) return made.error();
  return place_model(std::move(made->model), options, stop);
}

}  // namespace strake::cli
