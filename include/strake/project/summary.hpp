// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "strake/core/result.hpp"
#include "strake/project/project.hpp"
#include "strake/project/update.hpp"

/// What a project is, at a glance.
namespace strake::project {

struct Summary {
  std::int64_t schema_version = 0;
  std::uint64_t bytes = 0;  ///< of the database, with what was freed in it
  std::vector<StoredFile> files;
  std::uint64_t objects = 0, bodies = 0;
  std::uint64_t revisions = 0;
  std::optional<Revision> last_revision;
  std::uint64_t tests = 0, runs = 0, clashes = 0, views = 0;
};

/// Errors: input for a damaged project.
[[nodiscard]] Result<Summary> summary(Project& project);

}  // namespace strake::project
