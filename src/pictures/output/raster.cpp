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

  /// Where a point of the sheet lies between two of the shade; `weight` is that of the second, of
  /// kWeights.
  struct Interpolation {
    std::uint32_t first = 0, second = 0, weight = 0;
    bool inside = false;
  };
  static constexpr std::uint32_t kWeights = 256;

  /// Returns where the points of the sheet lie, `begin` to begin + length, over `count` of the
  /// shade.
  static std::vector<Interpolation> between(std::uint32_t points, double begin, double length,
                                            std::uint32_t count) {
    std::vector<Interpolation> all(points);
    for (std::uint32_t i = 0; i < points; ++i) {
      const double share = (i + 0.5 - begin) / length;
      if (share < 0 || share >= 1) continue;
      const double at = std::clamp(share * count - 0.5, 0.0, count - 1.0);
      const auto first = static_cast<std::uint32_t>(at);
      all[i] = {first, std::min(first + 1, count - 1),
                static_cast<std::uint32_t>((at - first) * kWeights + 0.5), true};
    }
    return all;
  }

  void add_shade() {
    const Shade& shade = picture_.shade;
    if (shade.points.empty()) return;
    const auto columns = between(width_, left_, picture_.width_mm * per_mm_, shade.width);
    const auto rows = between(height_, top_, picture_.view_mm * per_mm_, shade.height);
    for (std::uint32_t row = 0; row < height_; ++row) {
      if (!rows[row].inside) continue;
      const Colour* const above = &shade.points[std::size_t{rows[row].first} * shade.width];
      const Colour* const below = &shade.points[std::size_t{rows[row].second} * shade.width];
      std::uint8_t* point = &bytes_[std::size_t{row} * width_ * 3];
      for (std::uint32_t column = 0; column < width_; ++column, point += 3) {
        const Interpolation& at = columns[column];
        if (!at.inside) continue;
        const auto mix = [&](std::uint8_t Colour::* channel) {
          const auto across = [&](const Colour* of_row) {
            return of_row[at.first].*channel * (kWeights - at.weight) +
                   of_row[at.second].*channel * at.weight;
          };
          const std::uint32_t sum =
              across(above) * (kWeights - rows[row].weight) + across(below) * rows[row].weight;
          return static_cast<std::uint8_t>((sum + kWeights * kWeights / 2) / (kWeights * kWeights));
        };
        point[0] = mix(&Colour::red);
        point[1] = mix(&Colour::green);
        point[2] = mix(&Colour::blue);
      }
    }
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
  constexpr std::uint32_t kMin = 16, kMax = 8192;
  if (std::min(width_px, height_px) < kMin || std::max(width_px, height_px) > kMax)
    return Error{ErrorCode::usage, "a PNG is not between 16 and 8192 points wide and high",
                 "picture", "1600 by 1200 is enough to print it"};
  try {
    return encode_png(width_px, height_px, Raster(picture, width_px, height_px).draw());
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

}  // namespace strake::pictures
