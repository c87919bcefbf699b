// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::project {

/// Returns the box of each object of a scene, grid units; empty without bodies. A box holds the
/// true surfaces of curved primitives too, so that it holds every finer mesh of them that a view
/// may ask for. Errors: cancelled, out of memory.
[[nodiscard]] Result<std::vector<geometry::Box3l>> object_boxes(const model::Scene& scene,
                                                                const parallel::Context& context);

}  // namespace strake::project
