// SPDX-License-Identifier: Apache-2.0
#include <agg2/agg_conv_curve.h>
#include <agg2/agg_conv_dash.h>
#include <agg2/agg_conv_stroke.h>
#include <agg2/agg_path_storage.h>
#include <agg2/agg_pixfmt_rgb.h>
#include <agg2/agg_rasterizer_scanline_aa.h>
#include <agg2/agg_renderer_base.h>
#include <agg2/agg_renderer_scanline.h>
#include <agg2/agg_rendering_buffer.h>
#include <agg2/agg_scanline_p.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <vector>

#include "drawing/lettering/glyph_outline.hpp"
#include "drawing/lettering/lettering.hpp"
#include "geometry/numeric/trig.hpp"
#include "pictures/clash_picture.hpp"
#include "pictures/output/png.hpp"

namespace strake::pictures {
namespace {

constexpr std::uint8_t kPaper = 255;

/// A sheet of points, and how a picture lies on it.
class Raster {
 public:
  Raster(const ClashPicture& picture, std::uint32_t width, std::uint32_t height)
      : picture_(picture),
        width_(width),
        height_(height),
        bytes_(std::size_t{width} * height * 3, kPaper),
        buffer_(bytes_.data(), width, height, static_cast<int>(width * 3)),
        format_(buffer_),
        base_(format_) {
    per_mm_ = std::min(width / picture.width_mm, height / picture.height_mm);
    left_ = (width - picture.width_mm * per_mm_) / 2;
    top_ = (height - picture.height_mm * per_mm_) / 2;
  }

  std::vector<std::uint8_t> draw() && {
    add_shade();
    add_lines();
    for (const PictureRing& ring : picture_.rings) add_ring(ring);
    for (const PictureBlock& block : picture_.blocks) add_block(block);
    for (const PictureText& text : picture_.texts) add_text(text);
    return std::move(bytes_);
  }

 private:
  [[nodiscard]] double x(double mm) const { return left_ + mm * per_mm_; }
  [[nodiscard]] double y(double mm) const { return top_ + mm * per_mm_; }
  /// Thinner strokes than this many points fade until nobody sees them.
  [[nodiscard]] double stroke(double mm) const {
    constexpr double kThinnest = 0.8;
    return std::max(kThinnest, mm * per_mm_);
  }

  void add_shade() {
    const Shade& shade = picture_.shade;
    if (shade.points.empty()) return;
    for (std::uint32_t row = 0; row < height_; ++row)
      for (std::uint32_t column = 0; column < width_; ++column) {
        const double across = (column + 0.5 - left_) / (picture_.width_mm * per_mm_);
        const double down = (row + 0.5 - top_) / (picture_.view_mm * per_mm_);
        if (across < 0 || across >= 1 || down < 0 || down >= 1) continue;
        const Colour colour = shade_at(across * shade.width - 0.5, down * shade.height - 0.5);
        std::uint8_t* const point = &bytes_[(std::size_t{row} * width_ + column) * 3];
        point[0] = colour.red;
        point[1] = colour.green;
        point[2] = colour.blue;
      }
  }

  /// Returns the shade between its points.
  [[nodiscard]] Colour shade_at(double column, double row) const {
    const Shade& shade = picture_.shade;
    const double x0 = std::clamp(column, 0.0, shade.width - 1.0);
    const double y0 = std::clamp(row, 0.0, shade.height - 1.0);
    const auto left = static_cast<std::size_t>(x0), top = static_cast<std::size_t>(y0);
    const std::size_t right = std::min<std::size_t>(left + 1, shade.width - 1);
    const std::size_t below = std::min<std::size_t>(top + 1, shade.height - 1);
    const double across = x0 - static_cast<double>(left), down = y0 - static_cast<double>(top);
    const auto mix = [&](std::uint8_t Colour::* channel) {
      const auto at = [&](std::size_t c, std::size_t r) {
        return static_cast<double>(shade.points[r * shade.width + c].*channel);
      };
      const double above = at(left, top) * (1 - across) + at(right, top) * across;
      const double under = at(left, below) * (1 - across) + at(right, below) * across;
      return static_cast<std::uint8_t>(above * (1 - down) + under * down + 0.5);
    };
    return {mix(&Colour::red), mix(&Colour::green), mix(&Colour::blue)};
  }

  template <class Path>
  void fill(Path& path, const Colour& colour) {
    rasterizer_.add_path(path);
    agg::render_scanlines_aa_solid(rasterizer_, scanline_, base_,
                                   agg::rgba8(colour.red, colour.green, colour.blue));
  }

  template <class Path>
  void draw_strokes(Path& path, double width, const Colour& colour) {
    agg::conv_stroke<Path> strokes(path);
    strokes.width(width);
    strokes.line_cap(agg::round_cap);
    strokes.line_join(agg::round_join);
    fill(strokes, colour);
  }

  /// Draws lines of one look at once, so that where they cross they are no darker.
  void add_lines() {
    const auto alike = [](const PictureLine& a, const PictureLine& b) {
      return a.width_mm == b.width_mm && a.colour == b.colour && a.dashed == b.dashed;
    };
    const std::vector<PictureLine>& lines = picture_.lines;
    for (std::size_t first = 0, end = 0; first < lines.size(); first = end) {
      agg::path_storage path;
      for (; end < lines.size() && alike(lines[first], lines[end]); ++end) {
        path.move_to(x(lines[end].a.x), y(lines[end].a.y));
        path.line_to(x(lines[end].b.x), y(lines[end].b.y));
      }
      const double width = stroke(lines[first].width_mm);
      if (!lines[first].dashed) {
        draw_strokes(path, width, lines[first].colour);
        continue;
      }
      agg::conv_dash<agg::path_storage> dashes(path);
      dashes.add_dash(kDashMm * per_mm_, kGapMm * per_mm_);
      draw_strokes(dashes, width, lines[first].colour);
    }
  }

  void add_ring(const PictureRing& ring) {
    constexpr int kCorners = 72;
    agg::path_storage circle;
    for (const geometry::SinCos& at : geometry::unit_circle(kCorners)) {
      const double right = x(ring.at.x + ring.radius_mm * at.cos);
      const double down = y(ring.at.y + ring.radius_mm * at.sin);
      if (circle.total_vertices() == 0)
        circle.move_to(right, down);
      else
        circle.line_to(right, down);
    }
    circle.close_polygon();
    if (ring.filled)
      fill(circle, ring.colour);
    else
      draw_strokes(circle, stroke(ring.width_mm), ring.colour);
  }

  void add_block(const PictureBlock& block) {
    agg::path_storage path;
    path.move_to(x(block.at.x), y(block.at.y));
    path.line_to(x(block.at.x + block.width_mm), y(block.at.y));
    path.line_to(x(block.at.x + block.width_mm), y(block.at.y + block.height_mm));
    path.line_to(x(block.at.x), y(block.at.y + block.height_mm));
    path.close_polygon();
    fill(path, block.colour);
  }

  void add_text(const PictureText& given) {
    drawing::Letterer letterer;
    const drawing::LetteredText text = letterer.set(given.text);
    const drawing::TrueTypeFont& font = letterer.font();
    const double size = given.height_mm * per_mm_ * 1000 / font.metrics().cap_height;
    double left = x(given.at.x) - (given.centred ? text.width * size / 2 : 0);
    agg::path_storage letters;
    for (const drawing::GlyphId glyph : text.glyphs) {
      for (const drawing::GlyphContour& contour : outline_of(font, glyph))
        add_contour(letters, contour, left, y(given.at.y), size / 1000);
      left += font.advance(glyph) * size / 1000;
    }
    agg::conv_curve<agg::path_storage> curves(letters);
    fill(curves, given.colour);
    // The font has no bold letters.
    constexpr double kBold = 0.06;
    if (given.bold) draw_strokes(curves, kBold * size, given.colour);
  }

  /// Adds a contour of a letter whose origin is at a point, y down.
  static void add_contour(agg::path_storage& path, const drawing::GlyphContour& contour,
                          double left, double baseline, double scale) {
    const auto right = [&](const drawing::OutlinePoint& p) { return left + p.x * scale; };
    const auto down = [&](const drawing::OutlinePoint& p) { return baseline - p.y * scale; };
    path.move_to(right(contour[0]), down(contour[0]));
    for (std::size_t i = 1; i < contour.size(); ++i) {
      const drawing::OutlinePoint& p = contour[i];
      if (p.on) {
        path.line_to(right(p), down(p));
        continue;
      }
      const drawing::OutlinePoint& end = contour[(i + 1) % contour.size()];
      path.curve3(right(p), down(p), right(end), down(end));
      ++i;
    }
    path.close_polygon();
  }

  static constexpr double kDashMm = 1.4, kGapMm = 1.0;

  const ClashPicture& picture_;
  std::uint32_t width_, height_;
  double per_mm_ = 1, left_ = 0, top_ = 0;
  std::vector<std::uint8_t> bytes_;
  agg::rendering_buffer buffer_;
  agg::pixfmt_rgb24 format_;
  agg::renderer_base<agg::pixfmt_rgb24> base_;
  agg::rasterizer_scanline_aa<> rasterizer_;
  agg::scanline_p8 scanline_;
};

}  // namespace

Result<std::string> png_of(const ClashPicture& picture, std::uint32_t width_px,
                           std::uint32_t height_px) {
  constexpr std::uint32_t kLeast = 16, kMost = 8192;
  if (std::min(width_px, height_px) < kLeast || std::max(width_px, height_px) > kMost)
    return Error{ErrorCode::usage, "a PNG is not between 16 and 8192 points wide and high",
                 "picture", "1600 by 1200 is enough to print it"};
  try {
    return encode_png(width_px, height_px, Raster(picture, width_px, height_px).draw());
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

}  // namespace strake::pictures
