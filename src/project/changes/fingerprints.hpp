// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::project {

/// Hashes of what an object is: two objects agree in what a hash is of where it is equal. The order
/// of bodies counts. How precise the numbers of a source are is no part of it.
struct Fingerprint {
  Hash128 shapes;      ///< of its bodies, and whether it lacks some
  Hash128 places;      ///< placements of its bodies
  Hash128 paints;      ///< colours and categories of its bodies
  Hash128 appearance;  ///< different colours and categories: of objects with other bodies
  Hash128 naming;      ///< its name and those of the groups above
  Hash128 facts;       ///< what it and the groups above state
};

/// Returns an entry for each object. Errors: cancelled, memory.
[[nodiscard]] Result<std::vector<Fingerprint>> fingerprints(const model::Model& model,
                                                            const parallel::Context& context);

}  // namespace strake::project
