// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "strake/core/result.hpp"

namespace strake::pictures {

/// A folder that appears whole or not at all: files are put into one beside it, which takes its
/// place at the end. Without a commit the destructor removes what was put there.
class NewFolder {
 public:
  /// Errors: output.
  [[nodiscard]] static Result<NewFolder> beside(const std::filesystem::path& target);
  ~NewFolder();
  NewFolder(NewFolder&& other) noexcept;
  NewFolder& operator=(NewFolder&& other) = delete;
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  /// Where files go for now.
  [[nodiscard]] const std::filesystem::path& path() const { return temporary_; }
  /// Puts it in the place of the target, which is removed where it is there. Errors: output.
  [[nodiscard]] Status commit();

 private:
  NewFolder() = default;

  std::filesystem::path target_, temporary_;
};

}  // namespace strake::pictures
