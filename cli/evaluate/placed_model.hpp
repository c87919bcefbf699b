// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <stop_token>

#include "strake/core/result.hpp"
#include "strake/generate/ship.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"

namespace strake::cli {

/// A model on the grid, with all that its scene refers to.
struct PlacedModel {
  std::unique_ptr<const model::Model> model;
  model::Scene scene;
  geometry::Box3l box = geometry::empty_box<std::int64_t>();
  std::uint64_t triangles = 0;  ///< of the distinct shapes, counted at each body
};

/// Return a model, or a generated ship, on the grid, placed by all workers of the machine. Errors:
/// those of generate_ship() and make_scene().
[[nodiscard]] Result<PlacedModel> place_model(model::Model model,
                                              const model::SceneOptions& options,
                                              const std::stop_token& stop);
[[nodiscard]] Result<PlacedModel> place_ship(const generate::ShipOptions& ship,
                                             const model::SceneOptions& options,
                                             const std::stop_token& stop);

}  // namespace strake::cli
