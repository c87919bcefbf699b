// SPDX-License-Identifier: Apache-2.0
// Parts of lay_out(): the hash of a view and the counts of its lines.
#pragma once

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// Returns the hash of the view and of every piece in the model. It does not depend on the team.
/// Errors: cancelled, out of memory.
[[nodiscard]] Result<Hash128> hash_of(const hlr::Drawing& drawing, const model::Model& model,
                                      const parallel::Context& context);

/// Counts the lines of a drawing by state, and makes drawn objects without visible lines on paper
/// coincident. Errors: cancelled.
[[nodiscard]] Status count_lines(NeutralDrawing& drawing, const parallel::Context& context);

}  // namespace strake::drawing
