// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "project/database/database.hpp"
#include "project/review/decide_if_unchanged.hpp"
#include "serve/http/message.hpp"
#include "strake/core/result.hpp"

/// What the page is sent of the project, as JSON.
namespace strake::serve {

/// How many clashes the page is told about at once; where more changed, it has to be loaded anew.
inline constexpr std::size_t kMaxChanges = 20'000;

/// Returns what changed after an event, and `done` of what was just decided where that is given:
/// {"run", "event", "too_many", "clashes": [{"key", "status", "by", "on", "assignee", "comment"}],
/// "changed", "refused": [{"key", "why"}]}. Errors: those of reading the project.
[[nodiscard]] Result<std::string> project_answer(project::Database& database, std::int64_t event,
                                                 const project::DecideOutcome* done);

/// Returns the answer for an error: {"error", "mend"}.
[[nodiscard]] Answer error_answer(const Error& error);

}  // namespace strake::serve
