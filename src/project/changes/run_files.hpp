// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/file_match.hpp"

namespace strake::project {

/// Returns the files of a finished model as report::match_files() takes them: all lasting ids, and
/// what lies where. Errors: cancelled, memory.
[[nodiscard]] Result<report::RunFiles> run_files(const model::Model& model,
                                                 const parallel::Context& context);

}  // namespace strake::project
