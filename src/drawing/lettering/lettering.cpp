// SPDX-License-Identifier: Apache-2.0
#include "drawing/lettering/lettering.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "core/text_encoding.hpp"
#include "drawing/lettering/font_data.hpp"

namespace strake::drawing {
namespace {

/// Whether a character belongs to writing that is not set glyph by glyph from left to right: Hebrew
/// to Arabic, and their forms for presentation.
bool needs_shaping(std::uint32_t code) {
  return (code >= 0x0590 && code <= 0x08FF) || (code >= 0xFB1D && code <= 0xFDFF) ||
         (code >= 0xFE70 && code <= 0xFEFE) || (code >= 0x10800 && code <= 0x10FFF);
}

constexpr std::uint32_t kReplacementCode = 0xFFFD;

}  // namespace

Letterer::Letterer() : font_(font_data()) {}

LetteredText Letterer::set(std::string_view text) {
  LetteredText set;
  const std::string_view whole = text;
  while (!text.empty()) {
    const DecodedCharacter c = decode_character(text);
    const bool shown = is_printable(c);
    set.text += shown ? c.bytes : kReplacement;
    const std::uint32_t code = shown ? c.code : kReplacementCode;
    const GlyphId glyph = needs_shaping(code) ? kMissingGlyph : font_.glyph_of(code);
    if (glyph == kMissingGlyph) {
      set.lacking = true;
      if (!missing_.contains(code)) missing_.emplace(code, printable(whole.substr(0, 60)));
    }
    used_.emplace(glyph, glyph == kMissingGlyph ? kReplacementCode : code);
    set.glyphs.push_back(glyph);
    set.width += font_.advance(glyph) / 1000;
  }
  return set;
}

Diagnostics Letterer::diagnostics() const {
  Diagnostics found;
  for (const auto& [code, text] : missing_)
    found.add(Severity::warning, "text-character-missing",
              fmt::format("the font of the drawing cannot show the character U+{:04X}: a box "
                          "stands for it",
                          code),
              "the text " + in_quotes(text));
  return found;
}

LetterWidths::LetterWidths() : font_(font_data()) {}

double LetterWidths::of(const DecodedCharacter& character) const {
  const GlyphId glyph = character.length > 0 ? font_.glyph_of(character.code) : kMissingGlyph;
  if (glyph != kMissingGlyph) return std::round(font_.advance(glyph)) / 1000;
  constexpr double kSquareLetter = 1.05, kOtherLetter = 0.8;
  constexpr std::uint32_t kFirstSquareLetter = 0x1100;
  return character.code >= kFirstSquareLetter ? kSquareLetter : kOtherLetter;
}

}  // namespace strake::drawing
