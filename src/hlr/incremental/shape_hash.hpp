// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// A shape as signatures see it.
struct HashedShape {
  Hash128 hash;                 ///< of its parts, from the corner
  geometry::Vec3l corner;       ///< the lowest of its box, in the coordinates of its bodies
  bool made_for_views = false;  ///< views tessellate it anew
};

/// Hashes the shapes of a scene. A hash does not show in which of several equal meshes, which lie
/// in other places, the scene found a shape first. Errors: cancelled.
[[nodiscard]] Result<std::vector<HashedShape>> hash_shapes(const model::Scene& scene,
                                                           const parallel::Context& context);

}  // namespace strake::hlr
