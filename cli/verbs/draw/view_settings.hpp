// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "cli/verbs/draw/draw_request.hpp"
#include "strake/core/result.hpp"

/// The options of `draw` that make a stored view, as text.
namespace strake::cli {

/// Returns the options as they were written, as a JSON object of their names: those that were given
/// of all that say what is drawn and how, none of those that say where to or with how much work.
[[nodiscard]] std::string settings_text(const DrawOptions& given);

/// Reads such text. Errors: input for text that is none, or has an option that this version does
/// not know.
[[nodiscard]] Result<DrawOptions> parse_settings(std::string_view text, const std::string& where);

/// Returns the name of the first option given that decides which lines there are, or how they are
/// found, as "--section"; empty where all that is given concerns the sheet and its ink.
[[nodiscard]] std::string first_option_of_lines(const DrawOptions& given);

/// Puts the options given that concern the sheet and its ink in the place of those of a view.
void put_on_sheet_of(const DrawOptions& given, DrawOptions& view);

}  // namespace strake::cli
