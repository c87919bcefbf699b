// SPDX-License-Identifier: Apache-2.0
// What is done to the ink of a view beside choosing it: conventions of drawings, each if requested.
#pragma once

// Decision 0103 says what is ink and what is geometry of them.

#include <optional>

#include "strake/core/result.hpp"
#include "strake/drawing/centre_lines.hpp"
#include "strake/drawing/drawing.hpp"
#include "strake/drawing/ink.hpp"
#include "strake/drawing/thinning.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::drawing {

struct Conventions {
  std::optional<CentreLineOptions> centre_lines;
  bool break_lines = false;
  std::optional<ThinOptions> thin;
};

/// Adds centre lines and break lines to the ink, and then thins it, so that what is left out has
/// been seen by the others. Errors: cancelled.
[[nodiscard]] Status apply_conventions(Ink& ink, const NeutralDrawing& drawing,
                                       const model::Model& model, const Conventions& conventions,
                                       const parallel::Context& context);

}  // namespace strake::drawing
