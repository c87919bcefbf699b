// SPDX-License-Identifier: Apache-2.0
#include "io/nearby_file.hpp"

#include <string>
#include <system_error>

namespace strake::io {
namespace {

/// Whether `inner` lies below `folder`, symbolic links followed.
bool lies_below(const std::filesystem::path& inner, const std::filesystem::path& folder) {
  std::error_code failed;
  const std::filesystem::path real_inner = std::filesystem::weakly_canonical(inner, failed);
  if (failed) return false;
  const std::filesystem::path real_folder = std::filesystem::weakly_canonical(folder, failed);
  if (failed) return false;
  const std::filesystem::path relative = real_inner.lexically_relative(real_folder);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

std::optional<std::filesystem::path> nearby_path(const std::filesystem::path& referring_file,
                                                 std::string_view name) {
  if (name.empty() || name.find('\0') != std::string_view::npos) return std::nullopt;
  std::string portable(name);
  for (char& c : portable)
    if (c == '\\') c = '/';
  const std::filesystem::path relative(portable);
  if (relative.is_absolute() || portable.find("://") != std::string::npos) return std::nullopt;
  if (portable.size() > 1 && portable[1] == ':') return std::nullopt;  // a drive letter
  for (const std::filesystem::path& step : relative)
    if (step == "..") return std::nullopt;
  std::filesystem::path folder = referring_file.parent_path();
  if (folder.empty()) folder = ".";
  std::filesystem::path found = folder / relative;
  if (!lies_below(found, folder)) return std::nullopt;
  return found;
}

}  // namespace strake::io
