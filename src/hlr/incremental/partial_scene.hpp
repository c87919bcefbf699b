// SPDX-License-Identifier: Apache-2.0
// A scene of some of the objects of another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/scene/view_tessellation.hpp"
#include "strake/model/scene.hpp"

namespace strake::hlr {

/// Some objects of a scene, with the bodies and shapes that they have; the others have none. They
/// keep their numbers and their order.
struct PartialScene {
  model::Scene scene;
  std::vector<std::uint32_t> shapes;  ///< of the scene's shapes: their numbers in the other one

  /// Returns the plan of the other scene for the shapes of this one.
  [[nodiscard]] model::ViewTessellation plan(const model::ViewTessellation& whole) const;
};

/// Returns the scene of some objects; `wanted` is by object.
[[nodiscard]] PartialScene scene_of(const model::Scene& scene, const std::vector<bool>& wanted);

}  // namespace strake::hlr
