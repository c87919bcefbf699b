// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "project/database/database.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"

namespace strake::project {

/// Returns the model that io::read_models() returned for the files of a project. Errors: input;
/// memory; cancelled.
[[nodiscard]] Result<model::Model> load_model(Database& database, const parallel::Context& context);

}  // namespace strake::project
