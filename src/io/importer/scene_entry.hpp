// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/importer/import_report.hpp"

namespace strake::io {

/// A file as it was, so that another can be distinguished from it without being read.
struct FileStamp {
  std::string path;
  std::int64_t size = -1;  ///< in bytes; below zero: there is none
  std::int64_t time = 0;   ///< of its last change, in nanoseconds

  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

[[nodiscard]] FileStamp stamp_of(const std::filesystem::path& file);

/// What a kept scene says of itself.
struct EntryFacts {
  std::string file;  ///< the name of the model file that it was first made of
  SceneFacts scene;
  std::vector<FileStamp> importer;  ///< the program's own files, as they were
};

/// An entry is the scene as the importer wrote it, then the facts as JSON, then how long both are
/// and the hash of all before: one file, so that two processes cannot mix theirs.
///
/// Returns what is appended to a scene.
[[nodiscard]] std::string entry_trailer(std::span<const std::byte> scene, const EntryFacts& facts);

/// Returns the facts of an entry without reading its scene; nothing where it is none.
[[nodiscard]] std::optional<EntryFacts> read_entry_facts(const std::filesystem::path& file);

/// Returns the scene in the bytes of an entry; nothing where they are not what was written.
[[nodiscard]] std::optional<std::span<const std::byte>> scene_in(std::span<const std::byte> entry);

}  // namespace strake::io
