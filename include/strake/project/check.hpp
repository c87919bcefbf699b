// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/parallel/context.hpp"
#include "strake/project/project.hpp"

/// Whether a project is what it should be.
namespace strake::project {

/// Something in a project that cannot be right.
struct Fault {
  std::string where;  ///< the table, file, test or view
  std::string what;
};

/// Looks at everything in a project: what SQLite says of the database and of its references, the
/// model out of all its blocks and the shapes that it shares, the results of each test and their
/// clashes, the drawing of each view. Errors: cancelled, memory.
[[nodiscard]] Result<std::vector<Fault>> check(Project& project, const parallel::Context& context);

}  // namespace strake::project
