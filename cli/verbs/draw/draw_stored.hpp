// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/run/exit_code.hpp"
#include "cli/run/session.hpp"
#include "cli/verbs/draw/draw_request.hpp"
#include "strake/core/result.hpp"

namespace strake::cli {

/// Runs 'strake draw -p FILE --save NAME' and '--stored NAME'. What is drawn is what a run without
/// a memory draws with hidden lines kept: of what is remembered, only lines are used whose objects,
/// view and options have the signatures of now.
[[nodiscard]] Result<ExitCode> draw_stored(Session& session, const DrawOptions& given);

}  // namespace strake::cli
