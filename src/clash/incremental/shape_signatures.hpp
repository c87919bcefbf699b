// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::clash {

/// Hashes of shapes, each made once.
struct ShapeSignatures {
  /// By shape of the scene: all that is known of its parts on the grid. What follows from vertices
  /// and triangles alone, as edges do, is left out.
  std::vector<Hash128> on_grid;
  /// By shape of the model: the points of a mesh or of polylines, as the source has them, or all
  /// that there is of them.
  std::vector<Hash128> of_source;
};

/// Hashes the shapes of a scene; those of the model have the hashes `known`, if there are any, but
/// for zeros. Errors: cancelled.
[[nodiscard]] Result<ShapeSignatures> shape_signatures(const model::Scene& scene,
                                                       std::span<const Hash128> known,
                                                       const parallel::Context& context);

}  // namespace strake::clash
