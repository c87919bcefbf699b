// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/bvh/scene_bvh.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::pictures {

/// Finds the bodies of a scene near a point without a look at all the others.
class SceneIndex {
 public:
  /// Errors: cancelled, out of memory.
  [[nodiscard]] static Result<SceneIndex> of(const model::Scene& scene,
                                             const parallel::Context& context);

  /// Returns the bodies whose boxes meet a box, grid units, ascending.
  [[nodiscard]] std::vector<std::uint32_t> bodies_in(const geometry::Box3l& box) const;

 private:
  explicit SceneIndex(geometry::SceneBvh tree) : tree_(std::move(tree)) {}

  geometry::SceneBvh tree_;
};

}  // namespace strake::pictures
