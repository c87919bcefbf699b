// SPDX-License-Identifier: Apache-2.0
// Texts as glyphs of the font that drawings carry with them, which of its glyphs were used, and the
// widths of letters.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/text_encoding.hpp"
#include "drawing/lettering/true_type.hpp"
#include "strake/core/diagnostics.hpp"

namespace strake::drawing {

/// A text on one line, glyph by glyph.
struct LetteredText {
  std::vector<GlyphId> glyphs;
  std::string text;      ///< what it says: valid UTF-8, characters that cannot be shown replaced
  double width = 0;      ///< in sizes of the font
  bool lacking = false;  ///< characters that the font lacks are boxes
};

/// Sets texts in the font of the library.
///
/// Controls, and characters that turn the direction of writing, become U+FFFD, as in SVG. Of other
/// characters the font shows those of Latin, Greek, Cyrillic, Armenian, Georgian and the signs of
/// science; writing that runs from right to left or joins its letters is not set, since that takes
/// more than a row of glyphs: such characters are boxes, as are those that the font lacks.
class Letterer {
 public:
  Letterer();

  [[nodiscard]] LetteredText set(std::string_view text);

  [[nodiscard]] const TrueTypeFont& font() const { return font_; }
  /// The glyphs of all texts so far, each with a character that it stands for.
  [[nodiscard]] const std::map<GlyphId, std::uint32_t>& used() const { return used_; }
  /// "text-character-missing": each character that is shown as a box, with the first text that has
  /// it.
  [[nodiscard]] Diagnostics diagnostics() const;

 private:
  TrueTypeFont font_;
  std::map<GlyphId, std::uint32_t> used_;
  std::map<std::uint32_t, std::string> missing_;  ///< character and the first text with it
};

/// Widths of characters, by which all texts of drawings are laid out, whatever program shows them.
/// The font is DejaVu Sans, the widest of those that "sans-serif" usually stands for.
class LetterWidths {
 public:
  LetterWidths();

  /// Returns the width of a character in sizes of the font, in whole thousandths. What the font
  /// lacks is as wide as such writing usually is.
  [[nodiscard]] double of(const DecodedCharacter& character) const;

 private:
  TrueTypeFont font_;
};

}  // namespace strake::drawing
