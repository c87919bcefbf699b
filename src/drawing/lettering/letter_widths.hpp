// SPDX-License-Identifier: Apache-2.0
// The widths of letters in the font of the library, by which all texts of drawings are laid out.
#pragma once

#include "core/text_encoding.hpp"
#include "drawing/lettering/true_type.hpp"

namespace strake::drawing {

/// Widths of characters, whatever program shows them. The font is DejaVu Sans, the widest of those
/// that "sans-serif" usually stands for.
class LetterWidths {
 public:
  LetterWidths();

  /// Returns the width of a character in sizes of the font, in whole thousandths. What the font
  /// lacks is as wide as such writing usually is.
  [[nodiscard]] double of(const TakenCharacter& character) const;

 private:
  TrueTypeFont font_;
};

}  // namespace strake::drawing
