// SPDX-License-Identifier: Apache-2.0
#include "pictures/folder/new_folder.hpp"

#include <string>
#include <system_error>
#include <utility>

namespace strake::pictures {
namespace {

namespace fs = std::filesystem;

Error cannot_write(const fs::path& target, const std::error_code& why) {
  return {ErrorCode::output, "cannot write the folder: " + why.message(), target.string(),
          "choose a place that can be written to"};
}

}  // namespace

Result<NewFolder> NewFolder::beside(const fs::path& target) {
  NewFolder folder;
  std::error_code fault;
  folder.target_ = fs::absolute(target, fault).lexically_normal();
  if (fault) return cannot_write(target, fault);
  if (!folder.target_.has_filename()) folder.target_ = folder.target_.parent_path();
  // What the mask of the process allows holds for this folder as for any other.
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries && !fault; ++i) {
    const fs::path name = folder.target_.parent_path() /
                          ("." + folder.target_.filename().string() + ".new" + std::to_string(i));
    if (!fs::create_directory(name, fault)) continue;
    folder.temporary_ = name;
    return folder;
  }
  return cannot_write(target, fault ? fault : std::make_error_code(std::errc::file_exists));
}

NewFolder::NewFolder(NewFolder&& other) noexcept
    : target_(std::move(other.target_)), temporary_(std::exchange(other.temporary_, {})) {}

NewFolder::~NewFolder() {
  std::error_code fault;
  if (!temporary_.empty()) fs::remove_all(temporary_, fault);
}

Status NewFolder::commit() {
  std::error_code fault;
  const fs::path old = temporary_.string() + ".old";
  const bool replaces = fs::exists(target_, fault);
  if (replaces) fs::rename(target_, old, fault);
  if (fault) return cannot_write(target_, fault);
  fs::rename(temporary_, target_, fault);
  if (fault) {
    std::error_code ignored;
    if (replaces) fs::rename(old, target_, ignored);
    return cannot_write(target_, fault);
  }
  temporary_.clear();
  if (replaces) fs::remove_all(old, fault);
  return {};
}

}  // namespace strake::pictures
