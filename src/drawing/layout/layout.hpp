// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/hlr/hlr.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// Of the view and of every piece in the model. The same for any team. Errors: cancelled, out of
/// memory.
[[nodiscard]] Result<Hash128> hash_of(const hlr::Drawing& drawing, const model::Model& model,
                                      const parallel::Context& context);

/// Counts the lines of a drawing by state, and finds out which of its drawn objects have visible
/// lines on paper: the others are coincident. Errors: cancelled.
[[nodiscard]] Status count_lines(NeutralDrawing& drawing, const parallel::Context& context);

}  // namespace strake::drawing
