// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "project/database/database.hpp"
#include "strake/core/result.hpp"
#include "strake/project/update.hpp"

namespace strake::project {

/// What happened to a file of the model.
struct FileEvent {
  std::string_view what;  ///< "added", "removed", "read", "renamed"
  std::string file;       ///< its label
  std::string before;     ///< that it had, where it was renamed
};

/// Writes a revision with its files and objects, and gives it its number. The caller has begun a
/// transaction. Errors: those of the database.
[[nodiscard]] Status store_revision(Database& database, Revision& revision,
                                    const std::vector<FileEvent>& files, const Changes& changes);

}  // namespace strake::project
