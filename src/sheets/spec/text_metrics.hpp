// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "strake/sheets/sheet.hpp"

namespace strake::sheets {

/// The size of a font whose capital letters have height 1.
inline constexpr double kFontSize = 1.4;

/// Returns the text with blanks for line breaks and tabs.
[[nodiscard]] std::string on_one_line(std::string text);

/// Returns the largest width of a text of capital height 1 in the usual sans-serif fonts.
[[nodiscard]] double text_width(std::string_view text);

/// Returns the box that a text covers: of one that is turned, the level box round it.
[[nodiscard]] PaperBox box_of(const Text& text);
/// Returns the box that a text would cover if it were level.
[[nodiscard]] PaperBox level_box_of(const Text& text);
/// Returns the corners of what a text covers, as it is read: lower left, lower right, upper right,
/// upper left.
[[nodiscard]] std::array<PaperPoint, 4> corners_of(const Text& text);
/// Returns level boxes that cover a text and little more: one unless it runs askew.
[[nodiscard]] std::vector<PaperBox> boxes_of(const Text& text);
/// Returns the box of a text of that width and height of capital letters, aligned to a point of its
/// base line.
[[nodiscard]] PaperBox box_of(const PaperPoint& at, Align align, double width_mm, double height_mm);

/// Returns the text, shrunk so far that it is no wider than `width_mm`, but not below
/// `min_height`.
[[nodiscard]] Text shrunk_to_width(Text text, double width_mm, double min_height);

/// Returns the text with its end replaced by "…", where it would be wider than `width_mm`.
[[nodiscard]] Text cut_to_width(Text text, double width_mm);

}  // namespace strake::sheets
