// SPDX-License-Identifier: Apache-2.0
// Numbers in the tables of a TrueType file, the most significant byte first; what lies beyond the
// end is zero.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "drawing/lettering/true_type.hpp"

namespace strake::drawing {

/// Returns a number of up to four bytes.
[[nodiscard]] inline std::uint32_t number_at(std::string_view bytes, std::size_t at,
                                             std::size_t length) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + length; ++i)
    value = value << 8U | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U);
  return value;
}
[[nodiscard]] inline std::uint32_t u16(std::string_view bytes, std::size_t at) {
  return number_at(bytes, at, 2);
}
[[nodiscard]] inline std::uint32_t u32(std::string_view bytes, std::size_t at) {
  return number_at(bytes, at, 4);
}
[[nodiscard]] inline std::int32_t i16(std::string_view bytes, std::size_t at) {
  return static_cast<std::int16_t>(u16(bytes, at));
}

/// A glyph that another one is put together from, and how it stands in it.
struct GlyphComponent {
  GlyphId glyph = kMissingGlyph;
  double dx = 0, dy = 0;  ///< units of the font
  double xx = 1, xy = 0, yx = 0, yy = 1;
};

/// Goes through the components of a glyph that has no outline of its own.
class GlyphComponents {
 public:
  explicit GlyphComponents(std::string_view outline) : bytes_(outline) {}

  /// Returns the next one; nothing behind the last.
  [[nodiscard]] std::optional<GlyphComponent> next() {
    constexpr std::uint32_t kWords = 1, kMoves = 2, kScale = 8, kMore = 0x20, kTwoScales = 0x40,
                            kMatrix = 0x80;
    if (!more_ || at_ >= bytes_.size()) return std::nullopt;
    const std::uint32_t flags = u16(bytes_, at_);
    GlyphComponent part;
    part.glyph = static_cast<GlyphId>(u16(bytes_, at_ + 2));
    const bool words = (flags & kWords) != 0;
    if ((flags & kMoves) != 0) {
      const auto byte = [&](std::size_t at) {
        return static_cast<std::int8_t>(number_at(bytes_, at, 1));
      };
      part.dx = words ? i16(bytes_, at_ + 4) : byte(at_ + 4);
      part.dy = words ? i16(bytes_, at_ + 6) : byte(at_ + 5);
    }
    at_ += words ? 8 : 6;
    const auto scale = [&] {
      constexpr double kOne = 1 << 14;
      at_ += 2;
      return i16(bytes_, at_ - 2) / kOne;
    };
    if ((flags & kScale) != 0) {
      part.xx = part.yy = scale();
    } else if ((flags & kTwoScales) != 0) {
      part.xx = scale();
      part.yy = scale();
    } else if ((flags & kMatrix) != 0) {
      part.xx = scale();
      part.xy = scale();
      part.yx = scale();
      part.yy = scale();
    }
    more_ = (flags & kMore) != 0;
    return part;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 10;
  bool more_ = true;
};

}  // namespace strake::drawing
