// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Names out of files, as a terminal shows them: '?' for characters that would command it or turn
/// the writing round, and no more than tells people anything, since a name may be a megabyte long.
namespace strake::cli {

/// Returns a line, cut where it is longer than a page.
[[nodiscard]] std::string shown_line(std::string_view line);

/// Returns a cell of a list, whose column is as wide as its widest cell; the middle of a long one
/// is left out.
[[nodiscard]] std::string shown_cell(std::string_view text);

}  // namespace strake::cli
