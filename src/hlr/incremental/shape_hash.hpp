// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

/// Returns a hash of each shape: its parts, from the lowest corner of its box, so that it does not
/// show in which of several equal meshes a scene found them first. Errors: cancelled.
[[nodiscard]] Result<std::vector<Hash128>> hash_shapes(const model::Scene& scene,
                                                       const parallel::Context& context);

}  // namespace strake::hlr
