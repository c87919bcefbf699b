// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// Size of a font whose capital letters are one high.
inline constexpr double kFontSize = 1.4;

/// The text with blanks for line breaks and tabs.
[[nodiscard]] std::string on_one_line(std::string text);

/// How wide a text of capital height 1 is at most in the usual sans-serif fonts.
[[nodiscard]] double text_width(std::string_view text);

/// What a text covers.
[[nodiscard]] PaperBox box_of(const Text& text);

/// The text as small as it must be to be no wider than that, but not below `least_height`.
[[nodiscard]] Text shrunk_to_width(Text text, double width_mm, double least_height);

}  // namespace strake::sheets
