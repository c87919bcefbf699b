// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "strake/io/reader.hpp"

namespace strake::test {

/// A folder of its own for one test, removed afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "strake-test-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  TemporaryFolder(TemporaryFolder&&) = delete;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Writes a file and returns its path.
  [[nodiscard]] std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// Reads bytes in memory as if they were the file `path`.
[[nodiscard]] inline Result<model::Model> read_bytes(const io::Reader& reader,
                                                     std::string_view bytes,
                                                     const std::filesystem::path& path,
                                                     const io::ReadOptions& options = {},
                                                     const parallel::Context& context = {}) {
  return reader.read({path, std::as_bytes(std::span(bytes))}, options, context);
}

/// The folder of real models, where there is one.
[[nodiscard]] inline std::optional<std::filesystem::path> data_folder() {
  const char* const folder = std::getenv("STRAKE_DATA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  return std::filesystem::path(folder);
}

}  // namespace strake::test
