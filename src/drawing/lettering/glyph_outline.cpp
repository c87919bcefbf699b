// SPDX-License-Identifier: Apache-2.0
#include "drawing/lettering/glyph_outline.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "drawing/lettering/font_bytes.hpp"

namespace strake::drawing {
namespace {

/// How a glyph stands in another one: x' = xx x + yx y + dx, and y' likewise.
struct GlyphPlacement {
  double xx = 1, xy = 0, yx = 0, yy = 1, dx = 0, dy = 0;

  [[nodiscard]] OutlinePoint of(const OutlinePoint& p) const {
    return {xx * p.x + yx * p.y + dx, xy * p.x + yy * p.y + dy, p.on};
  }
};

OutlinePoint halfway(const OutlinePoint& a, const OutlinePoint& b) {
  return {(a.x + b.x) / 2, (a.y + b.y) / 2, true};
}

/// Puts in the points that files leave out: those halfway between two that are not on the outline.
GlyphContour completed(const GlyphContour& given) {
  GlyphContour all;
  const auto on = std::ranges::find(given, true, &OutlinePoint::on);
  const auto begin = static_cast<std::size_t>(on == given.end() ? 0 : on - given.begin());
  if (on == given.end()) all.push_back(halfway(given.back(), given.front()));
  for (std::size_t i = 0; i < given.size(); ++i) {
    const OutlinePoint& next = given[(begin + i) % given.size()];
    if (!all.empty() && !next.on && !all.back().on) all.push_back(halfway(all.back(), next));
    all.push_back(next);
  }
  return all;
}

/// Reads outlines; what lies beyond the end of the bytes is zero.
class OutlineReader {
 public:
  explicit OutlineReader(const TrueTypeFont& font) : font_(font) {}

  void add(GlyphId glyph, const GlyphPlacement& placement, int depth) {
    constexpr int kDeepest = 6;
    const std::string_view bytes = font_.outline(glyph);
    if (bytes.empty() || depth > kDeepest) return;
    const std::int32_t contours = i16(bytes, 0);
    if (contours >= 0)
      add_simple(bytes, static_cast<std::size_t>(contours), placement);
    else
      add_composite(bytes, placement, depth);
  }

  std::vector<GlyphContour> finish(double per_unit) && {
    for (GlyphContour& contour : contours_)
      for (OutlinePoint& point : contour) {
        point.x *= per_unit;
        point.y *= per_unit;
      }
    return std::move(contours_);
  }

 private:
  static constexpr std::uint32_t kOn = 1, kShortX = 2, kShortY = 4, kRepeat = 8, kSameX = 16,
                                 kSameY = 32;

  /// Reads the steps from point to point along one axis.
  static void take_axis(std::string_view bytes, std::size_t& at,
                        const std::vector<std::uint32_t>& flags, std::uint32_t is_short,
                        std::uint32_t same, GlyphContour& points, double OutlinePoint::* axis) {
    double value = 0;
    for (std::size_t i = 0; i < flags.size(); ++i) {
      if ((flags[i] & is_short) != 0) {
        const double step = number_at(bytes, at++, 1);
        value += (flags[i] & same) != 0 ? step : -step;
      } else if ((flags[i] & same) == 0) {
        value += i16(bytes, at);
        at += 2;
      }
      points[i].*axis = value;
    }
  }

  void add_simple(std::string_view bytes, std::size_t contours, const GlyphPlacement& placement) {
    if (contours == 0) return;
    std::vector<std::size_t> ends;
    for (std::size_t c = 0; c < contours; ++c) ends.push_back(u16(bytes, 10 + 2 * c) + 1);
    std::size_t at = 10 + 2 * contours;
    at += 2 + u16(bytes, at);  // instructions
    std::vector<std::uint32_t> flags;
    while (flags.size() < ends.back() && at < bytes.size()) {
      const std::uint32_t flag = number_at(bytes, at++, 1);
      const std::size_t more = (flag & kRepeat) != 0 ? number_at(bytes, at++, 1) : 0;
      flags.insert(flags.end(), 1 + more, flag);
    }
    GlyphContour points(flags.size());
    for (std::size_t i = 0; i < flags.size(); ++i) points[i].on = (flags[i] & kOn) != 0;
    take_axis(bytes, at, flags, kShortX, kSameX, points, &OutlinePoint::x);
    take_axis(bytes, at, flags, kShortY, kSameY, points, &OutlinePoint::y);
    std::size_t first = 0;
    for (const std::size_t end : ends) {
      if (end > points.size() || end < first + 2) return;
      GlyphContour contour;
      for (; first < end; ++first) contour.push_back(placement.of(points[first]));
      contours_.push_back(completed(contour));
    }
  }

  void add_composite(std::string_view bytes, const GlyphPlacement& placement, int depth) {
    for (GlyphComponents parts(bytes); const auto part = parts.next();) {
      const GlyphComponent& c = *part;
      const OutlinePoint moved = placement.of({c.dx, c.dy});
      add(c.glyph,
          {placement.xx * c.xx + placement.yx * c.xy, placement.xy * c.xx + placement.yy * c.xy,
           placement.xx * c.yx + placement.yx * c.yy, placement.xy * c.yx + placement.yy * c.yy,
           moved.x, moved.y},
          depth + 1);
    }
  }

  const TrueTypeFont& font_;
  std::vector<GlyphContour> contours_;
};

}  // namespace

std::vector<GlyphContour> outline_of(const TrueTypeFont& font, GlyphId glyph) {
  OutlineReader reader(font);
  reader.add(glyph, {}, 0);
  return std::move(reader).finish(font.per_unit());
}

}  // namespace strake::drawing
