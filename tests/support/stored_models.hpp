// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/importer/map_place.hpp"
#include "project/database/database.hpp"
#include "project/model/model_store.hpp"
#include "strake/project/project.hpp"

namespace strake::test {

/// Reads files and stores them in a project, in one transaction; the first lies on a map as is
/// said.
[[nodiscard]] inline Status store(project::Project& project,
                                  std::span<const std::filesystem::path> paths,
                                  const parallel::Context& context = {},
                                  std::optional<io::MapPlace> map = {}) {
  std::vector<project::FileToStore> files;
  for (const std::filesystem::path& path : paths) {
    Result<project::FileToStore> file = project::read_file({path, {}}, context);
    if (!file) return file.error();
    if (map) file->map = std::exchange(map, std::nullopt);
    files.push_back(std::move(*file));
  }
  Result<project::Transaction> transaction = project::Transaction::begin(project.database());
  if (!transaction) return transaction.error();
  if (const Status stored = project::store_files(project, files, context); !stored) return stored;
  return transaction->commit();
}

/// Takes stored files out, in one transaction.
[[nodiscard]] inline Status take_out(project::Project& project,
                                     std::span<const std::int64_t> files) {
  Result<project::Transaction> transaction = project::Transaction::begin(project.database());
  if (!transaction) return transaction.error();
  if (const Status removed = project::remove_files(project, files, {}); !removed) return removed;
  return transaction->commit();
}

/// Returns the only value of the only row of a query, a whole number.
[[nodiscard]] inline std::int64_t number(project::Project& project, std::string_view query) {
  auto statement = project.database().prepare(query);
  if (!statement || !statement->step().value()) std::abort();
  return statement->integer(0);
}

}  // namespace strake::test
