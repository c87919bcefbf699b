// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "project/model/model_store.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/project/update.hpp"
#include "strake/report/file_match.hpp"

namespace strake::project {

/// A stored file, and the path of a file of the new model that it is, or a part of it.
struct FileLink {
  report::FileMatch match;  ///< `after` is filled in once labels are known
  std::filesystem::path now;
};

/// What an update stores and takes out.
struct FilePlan {
  std::vector<FileToStore> read;
  std::vector<std::int64_t> merged;  ///< files that became parts of others
  std::vector<FileLink> links;       ///< of stored files that are read again, or become parts
};

/// Returns the stored file of a path; null: none.
[[nodiscard]] const StoredFile* find_file(const std::vector<StoredFile>& files,
                                          const std::filesystem::path& path);

/// A file that has to be read again.
struct OutdatedFile {
  io::FileToRead file;
  const StoredFile* replaces = nullptr;  ///< the one of its path; null: not known yet
  std::string given = {};                ///< the path that diagnostics name
};

/// Returns the files that update() has to read. Errors: input for a file that cannot be read.
[[nodiscard]] Result<std::vector<OutdatedFile>> outdated_files(const std::vector<StoredFile>& files,
                                                               const UpdateRequest& request,
                                                               const parallel::Context& context);

/// Reads them, and finds out whose place those of other paths take; `then` is the model that the
/// project has. Errors: those of update().
[[nodiscard]] Result<FilePlan> plan_update(const std::vector<StoredFile>& files,
                                           const std::vector<OutdatedFile>& outdated,
                                           const std::vector<std::string>& given_pairs,
                                           const model::Model& then,
                                           const parallel::Context& context);

}  // namespace strake::project
