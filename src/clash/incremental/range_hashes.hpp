// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0106 says what may be known of objects without looking at them.

#include <vector>

#include "clash/incremental/shape_signatures.hpp"
#include "strake/clash/incremental.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/scene.hpp"
#include "strake/parallel/context.hpp"

namespace strake::clash {

/// Returns hashes of ranges of objects: of what their signatures are made from, without looking at
/// the model's objects and bodies. `inputs` is hash_of_inputs(). Nothing where too little is known.
/// Errors: cancelled.
[[nodiscard]] Result<std::vector<Hash128>> range_hashes(const model::Scene& scene,
                                                        const ShapeSignatures& shapes,
                                                        const Hash128& inputs,
                                                        const KnownModel& known,
                                                        const parallel::Context& context);

}  // namespace strake::clash
