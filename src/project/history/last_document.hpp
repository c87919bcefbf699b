// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "project/database/database.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash_document.hpp"

namespace strake::project {

/// Returns the result of the last run of a test, or of all tests of the last run where none is
/// named, as the run wrote it in full: with results of all classes, and by the names of the model
/// that it ran over, under the labels that its files have today. Errors: usage for a test that was
/// never run, for a project without runs and for a run of the first version of the tables; input
/// for a damaged project; cancelled.
[[nodiscard]] Result<report::ClashDocument> last_document(Database& database,
                                                          const std::optional<std::string>& test,
                                                          const parallel::Context& context);

}  // namespace strake::project
