// SPDX-License-Identifier: Apache-2.0
// What a template is drawn on: the contents of a PDF, or the layout of a DXF.
#pragma once

#include <string>

#include "sheets/output/artwork/svg_geometry.hpp"
#include "sheets/output/artwork/svg_style.hpp"

namespace strake::sheets {

/// A piece of a text where it stands.
struct ArtworkText {
  const std::string& text;
  const SvgStyle& style;
  Affine to_paper;        ///< from sizes of the font along and above its base line
  double width = 0;       ///< in sizes of the font
  bool anchored = false;  ///< it is the only one of its chunk: its anchor says what stays in place
};

class ArtworkCanvas {
 public:
  ArtworkCanvas() = default;
  ArtworkCanvas(const ArtworkCanvas&) = delete;
  ArtworkCanvas& operator=(const ArtworkCanvas&) = delete;
  ArtworkCanvas(ArtworkCanvas&&) = delete;
  ArtworkCanvas& operator=(ArtworkCanvas&&) = delete;
  virtual ~ArtworkCanvas() = default;

  /// Returns the width of a text in sizes of the font.
  [[nodiscard]] virtual double width_of(const std::string& text) = 0;
  /// Paints a path, which has something to paint. Pens are enlarged by `scale`.
  virtual void paint(const PathBuilder& path, const SvgStyle& style, double scale,
                     ReportUnsupported report) = 0;
  virtual void write(const ArtworkText& text) = 0;
};

}  // namespace strake::sheets
