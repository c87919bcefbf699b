// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "drawing/lettering/true_type.hpp"

namespace strake::drawing {

/// A point of an outline in thousandths of the size of the font, y up. One that is not on the
/// outline bends it towards itself: it is the middle point of a quadratic Bézier curve.
struct OutlinePoint {
  double x = 0, y = 0;
  bool on = true;
};

/// A closed line; it begins on the outline, and of two points that follow each other one is on it.
using GlyphContour = std::vector<OutlinePoint>;

/// Returns the contours of a glyph, with those of the glyphs that it is put together from; none of
/// one that shows nothing, as a blank. Parts that are placed by matching points stand at the
/// origin.
[[nodiscard]] std::vector<GlyphContour> outline_of(const TrueTypeFont& font, GlyphId glyph);

}  // namespace strake::drawing
