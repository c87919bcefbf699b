// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace strake::io {

/// The path of a file that another file names, if it lies in the same folder or below; nothing
/// for absolute names, names that climb out of the folder, and URLs, so that a model from
/// elsewhere cannot make this program read what its author should not see.
[[nodiscard]] std::optional<std::filesystem::path> nearby_path(
    const std::filesystem::path& referring_file, std::string_view name);

}  // namespace strake::io
