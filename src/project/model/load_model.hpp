// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "project/database/database.hpp"
#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/project/project.hpp"

namespace strake::project {

/// Returns the model that io::read_models() returned for the files of a project, with the hashes
/// that its shapes were stored with. Errors: input; memory; cancelled.
[[nodiscard]] Result<SignedModel> load_model(Database& database, const parallel::Context& context);

}  // namespace strake::project
