// SPDX-License-Identifier: Apache-2.0
#include "sheets/spec/text_metrics.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/text_encoding.hpp"

namespace strake::sheets {

namespace {

/// Advances of " " to "~" in thousandths of the size of the font: of DejaVu Sans, the widest of the
/// fonts that "sans-serif" usually stands for.
constexpr std::array<std::uint16_t, 95> kAdvances{
    318,  401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337,  //
    636,  636, 636, 636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531,  //
    1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295, 656, 557, 863, 748, 787,  //
    603,  787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838, 500,  //
    500,  613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612,  //
    635,  635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838};

double advance(const TakenCharacter& c) {
  if (c.length == 1 && c.code >= ' ' && c.code <= '~') return kAdvances.at(c.code - ' ') / 1000.0;
  return c.code >= 0x1100 ? 1.05 : 0.8;  // scripts of square letters; others
}

}  // namespace

std::string on_one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  return text;
}

double text_width(std::string_view text) {
  double width = 0;
  while (!text.empty()) width += advance(take_character(text));
  return width * kFontSize;
}

PaperBox box_of(const PaperPoint& at, Align align, double width_mm, double height_mm) {
  const double left = align == Align::start    ? at.x
                      : align == Align::middle ? at.x - width_mm / 2
                                               : at.x - width_mm;
  // A quarter of the height below the line for letters that hang.
  return {left, at.y - height_mm, left + width_mm, at.y + height_mm / 4};
}

PaperBox box_of(const Text& text) {
  return box_of(text.at, text.align, text_width(text.text) * text.height_mm, text.height_mm);
}

Text shrunk_to_width(Text text, double width_mm, double least_height) {
  const double wide = text_width(text.text) * text.height_mm;
  if (wide > width_mm) text.height_mm = std::max(least_height, text.height_mm * width_mm / wide);
  return text;
}

Text cut_to_width(Text text, double width_mm) {
  if (text_width(text.text) * text.height_mm <= width_mm) return text;
  constexpr std::string_view kEllipsis = "\xE2\x80\xA6";
  const double room = width_mm / text.height_mm - text_width(kEllipsis);
  std::string_view rest = text.text;
  double width = 0;
  std::size_t kept = 0;
  while (!rest.empty()) {
    width += advance(take_character(rest)) * kFontSize;
    if (width > room) break;
    kept = text.text.size() - rest.size();
  }
  text.text = text.text.substr(0, kept) + std::string(kEllipsis);
  return text;
}

}  // namespace strake::sheets
