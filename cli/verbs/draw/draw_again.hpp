// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/options/options.hpp"
#include "cli/run/exit_code.hpp"
#include "cli/run/session.hpp"
#include "cli/verbs/draw/draw_request.hpp"
#include "strake/core/result.hpp"

namespace strake::cli {

/// Whether any of the files is a drawing in its neutral form, by its content.
[[nodiscard]] bool holds_drawing(const InputOptions& input);

/// Writes a drawing again from its neutral form, with other ink, on other paper, in another format:
/// its lines are solved. Errors: usage for options that would need the model.
[[nodiscard]] Result<ExitCode> draw_again(Session& session, const DrawOptions& given);

}  // namespace strake::cli
