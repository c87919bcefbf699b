// SPDX-License-Identifier: Apache-2.0
#include "drawing/lettering/letter_widths.hpp"

#include <cmath>
#include <cstdint>

#include "drawing/lettering/font_data.hpp"

namespace strake::drawing {

LetterWidths::LetterWidths() : font_(font_data()) {}

double LetterWidths::of(const TakenCharacter& character) const {
  const GlyphId glyph = character.length > 0 ? font_.glyph_of(character.code) : kMissingGlyph;
  if (glyph != kMissingGlyph) return std::round(font_.advance(glyph)) / 1000;
  constexpr double kSquareLetter = 1.05, kOtherLetter = 0.8;
  constexpr std::uint32_t kFirstSquareLetter = 0x1100;
  return character.code >= kFirstSquareLetter ? kSquareLetter : kOtherLetter;
}

}  // namespace strake::drawing
