// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::clash {

/// Returns for each shape of a scene a hash of all that is known of its parts on the grid: what
/// follows from vertices and triangles alone, as edges do, is left out. Errors: cancelled.
[[nodiscard]] Result<std::vector<Hash128>> shape_signatures(const model::Scene& scene,
                                                            const parallel::Context& context);

}  // namespace strake::clash
