// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/model/model.hpp"

namespace strake::project {

/// Whether the bodies of two objects are the same but for one displacement of each mesh and of each
/// body, as far as the numbers of their sources tell: formats without placements state a move by
/// other corners. False where nothing is displaced by more than that, so that the shapes differ.
[[nodiscard]] bool is_displaced(const model::Model& then, const model::Object& before,
                                const model::Model& now, const model::Object& after);

}  // namespace strake::project
