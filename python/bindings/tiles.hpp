// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "strake/core/result.hpp"
#include "tiles/outline.hpp"

/// What clash runs and drawings by tiles share.
namespace strake::python {

/// Returns what reads the files, as read_arguments() has them, and keeps them in a folder.
[[nodiscard]] tiles::FileReader reader_of(const std::vector<std::filesystem::path>& paths,
                                          std::optional<double> unit_mm, std::optional<int> up_axis,
                                          bool on_map, const std::filesystem::path& importers,
                                          const std::filesystem::path& folder);

/// Returns the error of selections over files that are asked before their namesakes are known.
[[nodiscard]] Error same_names();

}  // namespace strake::python
