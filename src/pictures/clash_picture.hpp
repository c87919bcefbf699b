// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pictures/viewpoint.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/context.hpp"
#include "strake/report/clash.hpp"

/// Pictures of clashes: the two objects coloured, what is round them grey, drawn by the hidden-line
/// engine. Only the neighbourhood is drawn, so that a picture costs what lies in it.
///
///     const auto scenery = pictures::Scenery::of(contents, context);  // once for many pictures
///     const auto subject = pictures::subject_of(contents, group);
///     const auto seen = pictures::choose_viewpoint(*scenery, subject, {}, context);
///     const auto picture = pictures::draw_clash(*scenery, subject, *seen, {}, context);
///     const Result<std::string> png = pictures::png_of(*picture, 800, 600);
namespace strake::pictures {

/// Colours as #rrggbb. All who see colours distinguish the two of a clash, also in grey.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend bool operator==(const Colour&, const Colour&) = default;
};
inline constexpr Colour kColourOfA{0xd5, 0x5e, 0x00};  ///< vermilion of Okabe and Ito
inline constexpr Colour kColourOfB{0x00, 0x72, 0xb2};  ///< blue of Okabe and Ito
inline constexpr Colour kColourOfMark{0x11, 0x11, 0x11};

/// A point of a picture, millimetres from its upper left corner, y down.
struct PicturePoint {
  double x = 0, y = 0;
};

/// A straight stroke with round ends.
struct PictureLine {
  PicturePoint a, b;
  double width_mm = 0.25;
  Colour colour;
  bool dashed = false;
};

/// A ring, or a disc where filled.
struct PictureRing {
  PicturePoint at;
  double radius_mm = 1;
  double width_mm = 0.35;
  Colour colour;
  bool filled = false;
};

/// A line of text that starts at a point of its baseline, or is centred on it.
struct PictureText {
  PicturePoint at;
  double height_mm = 2.5;  ///< of capitals
  std::string text;        ///< as it was given: writers make it safe
  Colour colour;
  bool centred = false, bold = false;
};

/// A filled rectangle of one colour.
struct PictureBlock {
  PicturePoint at;
  double width_mm = 0, height_mm = 0;
  Colour colour;
};

/// What faces look like, one colour a point, rows from above: a picture under the lines.
struct Shade {
  std::uint32_t width = 0, height = 0;
  std::vector<Colour> points;
};

/// A picture without a format: SVG and PNG are both written from it.
struct ClashPicture {
  double width_mm = 160, height_mm = 120;
  double view_mm = 120;  ///< the height of the view; the caption stands below it
  std::string title;     ///< one line that says what is seen
  double mm_per_mm = 1;  ///< model mm per mm of the picture
  Shade shade;
  std::vector<PictureLine> lines;
  std::vector<PictureRing> rings;
  std::vector<PictureBlock> blocks;
  std::vector<PictureText> texts;
};

struct PictureOptions {
  double width_mm = 160, height_mm = 120;  ///< 40 to 1000 each
  /// Names, class, depth, scale and what the colours mean, under the view. Without it the picture
  /// is the view alone, for programs that say all that beside it (BCF, spreadsheets).
  bool caption = true;
  bool shaded = true;        ///< faces have colours, faint for what is not of the clash
  bool hidden_lines = true;  ///< what is hidden of the two objects is dashed
};

/// Returns width by height of the view of a picture, for ViewpointOptions::aspect.
[[nodiscard]] double view_aspect(const PictureOptions& options);

/// Draws what a viewpoint sees of a clash. Errors: usage for options out of range; cancelled, out
/// of memory.
[[nodiscard]] Result<ClashPicture> draw_clash(const Scenery& scenery, const Subject& subject,
                                              const ClashViewpoint& viewpoint,
                                              const PictureOptions& options,
                                              const parallel::Context& context);

/// Writes a picture as SVG in millimetres. Errors: out of memory.
[[nodiscard]] Status write_svg(const ClashPicture& picture, report::Sink sink);

/// Returns a picture as the bytes of a PNG of that size, 16 to 8192 each way; it fills the size,
/// and keeps its proportions with white beside. Letters are those of the font of drawings; what it
/// lacks is a box.
/// Errors: usage for a size out of range, out of memory.
[[nodiscard]] Result<std::string> png_of(const ClashPicture& picture, std::uint32_t width_px,
                                         std::uint32_t height_px);

}  // namespace strake::pictures
