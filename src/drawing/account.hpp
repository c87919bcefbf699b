// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/core/result.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

/// Counts the lines of a drawing by state, and finds out which of its drawn objects have visible
/// lines on paper: the others are coincident. Errors: cancelled.
[[nodiscard]] Status count_lines(NeutralDrawing& drawing, const parallel::Context& context);

}  // namespace strake::drawing
