// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <utility>

namespace strake::io {

/// How the folders begin in which importers work.
inline constexpr const char* kWorkPrefix = ".work-";

/// A new folder for one importer, gone with all that is in it when the value dies.
class WorkFolder {
 public:
  /// Makes a folder within another; null where that cannot be done.
  [[nodiscard]] static std::unique_ptr<WorkFolder> make(const std::filesystem::path& within);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  WorkFolder(WorkFolder&&) = delete;
  WorkFolder& operator=(WorkFolder&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  explicit WorkFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace strake::io
