// SPDX-License-Identifier: Apache-2.0
// A TrueType font as the tables of its file: characters, widths, and a font of some of its glyphs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

namespace strake::drawing {

using GlyphId = std::uint16_t;
/// The glyph that stands for characters that a font lacks: an empty box.
inline constexpr GlyphId kMissingGlyph = 0;

// Decision 0079 says why subsets are made here.

/// A font in the file that was put into the library. Its bytes are trusted, but never read beyond
/// their end: what lies there is zero.
class TrueTypeFont {
 public:
  /// The bytes must outlast the font.
  explicit TrueTypeFont(std::string_view file);

  /// Returns the glyph of a character; kMissingGlyph where the font has none.
  [[nodiscard]] GlyphId glyph_of(std::uint32_t code) const;
  /// Returns the width of a glyph in thousandths of the size of the font.
  [[nodiscard]] double advance(GlyphId glyph) const;

  /// Returns the outline of a glyph as the file has it; empty where it shows nothing.
  [[nodiscard]] std::string_view outline(GlyphId glyph) const;
  /// Returns the thousandths of the size that a unit of the file is.
  [[nodiscard]] double per_unit() const { return per_size_; }

  /// Measures in thousandths of the size, y up.
  struct Metrics {
    std::array<double, 4> box{};  ///< of all glyphs: left, bottom, right, top
    double ascent = 0, descent = 0, cap_height = 0;
  };
  [[nodiscard]] Metrics metrics() const;

  /// Returns a font file that has these glyphs and what they are put together from, each with the
  /// number that it has here; all other glyphs are empty. The same glyphs give the same bytes.
  [[nodiscard]] std::string subset(const std::set<GlyphId>& glyphs) const;

 private:
  [[nodiscard]] std::string_view table(std::string_view tag) const;
  [[nodiscard]] std::size_t glyph_count() const;
  [[nodiscard]] std::set<GlyphId> with_components(const std::set<GlyphId>& glyphs) const;
  [[nodiscard]] std::string widths_of(const std::set<GlyphId>& glyphs) const;

  std::string_view file_;
  std::string_view characters_;  ///< table of characters, of 32 bits where there is one
  std::string_view widths_, places_, outlines_;
  double per_size_ = 1;  ///< thousandths of the size per unit of the font
  std::size_t width_count_ = 0;
  bool long_places_ = false;
};

}  // namespace strake::drawing
