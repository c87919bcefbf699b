// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "strake/core/result.hpp"

namespace strake::settings {

/// Reads a whole file that a person wrote, of 16 MiB at most. `what` names its kind, as "rules
/// file", and `hint` says what may have been meant where the file is far too large for one.
[[nodiscard]] Result<std::string> read_text_file(const std::filesystem::path& file,
                                                 std::string_view what, std::string_view hint);

}  // namespace strake::settings
