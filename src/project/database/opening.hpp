// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "project/database/database.hpp"
#include "strake/core/result.hpp"

namespace strake::project {

/// How long a connection waits for what others do in a moment: the first to come after a crash puts
/// the write log in order, the last to go empties it.
inline constexpr int kRecoveryMs = 10'000;

/// Makes an empty project, whole or not at all. Errors: output, also where the file exists.
[[nodiscard]] Status make_project_file(const std::filesystem::path& file);

}  // namespace strake::project
