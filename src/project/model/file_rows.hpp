// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/importer/map_place.hpp"
#include "project/database/database.hpp"
#include "project/model/blocks.hpp"
#include "strake/core/hash.hpp"
#include "strake/core/result.hpp"
#include "strake/model/model.hpp"
#include "strake/project/project.hpp"

namespace strake::project {

/// A row of the table of files: StoredFile::source has the label that results call it by.
struct FileRow {
  StoredFile file;
  std::int64_t position = 0;
  std::string name;  ///< its label where it is alone
  std::uint64_t shapes = 0, groups = 0, group_attributes = 0;
  Hash128 blocks;                        ///< of what is in its blocks
  std::optional<io::MapPlace> map = {};  ///< where it lies on a map, if it says so
};

/// Returns all files, in the order in which they are read. Errors: input for a row that cannot be.
[[nodiscard]] Result<std::vector<FileRow>> read_rows(Database& database);

/// The same, where no file is missing and none has been changed by other than this program. Errors:
/// input.
[[nodiscard]] Result<std::vector<FileRow>> read_sealed_rows(Database& database);

/// Returns the hash of the rows of all files, and so of what is in their blocks: equal ones are of
/// the same model. Errors: input.
[[nodiscard]] Result<Hash128> model_seal(Database& database);

/// Writes a row: a new one where the id is 0.
[[nodiscard]] Status write_row(Database& database, FileRow& row);

/// Gives all files the labels that they have beside each other, and seals the rows: the last step
/// of every change of them.
[[nodiscard]] Status write_labels(Database& database);

/// Returns what model::finish() makes of the files' names: the files by label, and the number of
/// each of `rows` among them.
struct LabelledFiles {
  std::vector<model::SourceFile> files;
  std::vector<std::uint32_t> number;
};
[[nodiscard]] LabelledFiles labelled(const std::vector<FileRow>& rows);

}  // namespace strake::project
