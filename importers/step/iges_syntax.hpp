// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "strake/core/result.hpp"

namespace strake::import_step {

/// Whether a line is one of IGES: the letter of its section in column 73, then a number.
[[nodiscard]] bool is_iges_line(std::string_view line, char section);

/// Checks that an IGES file in ASCII is whole: sections in their order, lines numbered one by one,
/// and as many of each as the last line states. Open CASCADE reads what is cut off as if that were
/// all. Errors: input, with the line.
[[nodiscard]] Status check_iges_syntax(std::string_view text, const std::filesystem::path& file);

}  // namespace strake::import_step
