// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

namespace strake::project {

/// Returns the size of a file in bytes and when it was changed, in nanoseconds; nothing where there
/// is none.
[[nodiscard]] std::optional<std::pair<std::int64_t, std::int64_t>> size_and_time(
    const std::filesystem::path& file);

/// What the first page of a file says.
struct FileHead {
  bool is_database = false;    ///< of SQLite
  bool is_project = false;     ///< ours, by its application id
  bool has_write_log = false;  ///< it is in WAL mode, as every project
};

/// Reads it; nothing where the file cannot be read, with errno set.
[[nodiscard]] std::optional<FileHead> read_head(const std::filesystem::path& file);

}  // namespace strake::project
