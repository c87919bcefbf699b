// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "io/importer/map_place.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/io/reader.hpp"
#include "strake/model/model.hpp"
#include "strake/parallel/context.hpp"
#include "strake/project/project.hpp"

/// Model files of a project: read, stored, taken out. Project::model() gives them back.
namespace strake::project {

/// Returns the hash of what a model file says: of its bytes and of those of the files that are read
/// with it (attributes of an RVM file, buffers of a glTF file, materials of an OBJ file). Errors:
/// input for a file that cannot be read or is no model; memory; cancelled.
[[nodiscard]] Result<Hash128> content_hash(const std::filesystem::path& path,
                                           const parallel::Context& context);

/// A model file as it was read, alone.
struct FileToStore {
  std::filesystem::path path;  ///< as it was given; the project keeps it absolute
  io::ReadOptions options;
  Hash128 content;     ///< content_hash() of the file
  model::Model model;  ///< what io::read_models() returned for this file alone, finished
  /// The stored file whose place it takes, which has another path; nothing: the one of its path,
  /// or, where none is, it comes behind all others.
  std::optional<std::int64_t> replaces = {};
  std::string given = {};                ///< the path that diagnostics name
  std::optional<io::MapPlace> map = {};  ///< where its importer says that it lies
};

/// Reads a model file, whose content is known to be what the model was made of. Errors: those of
/// io::read_models(); input for a file that another program changes meanwhile.
[[nodiscard]] Result<FileToStore> read_file(const io::FileToRead& file,
                                            const parallel::Context& context);

/// Lets what was noticed name a file by another path, as a run does to which the file is given so.
void call_as_given(FileToStore& file, const std::string& given);

/// Stores files, in the order in which io::read_models() would be given them, and takes out what
/// they replace. The caller has begun a transaction. Errors: usage for a path that two of the files
/// have, or one and another stored file; those of the database; cancelled.
[[nodiscard]] Status store_files(Project& project, std::span<const FileToStore> files,
                                 const parallel::Context& context);

/// Takes files out, with the shapes that only they have. The caller has begun a transaction.
/// Errors: usage for a file that is not there; those of the database.
[[nodiscard]] Status remove_files(Project& project, std::span<const std::int64_t> files,
                                  const parallel::Context& context);

}  // namespace strake::project
