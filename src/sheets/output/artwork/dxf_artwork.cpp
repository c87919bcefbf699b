// SPDX-License-Identifier: Apache-2.0
#include "sheets/output/artwork/dxf_artwork.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drawing/lettering/lettering.hpp"
#include "geometry/numeric/trig.hpp"
#include "sheets/output/artwork/artwork.hpp"
#include "sheets/output/artwork/artwork_canvas.hpp"
#include "sheets/spec/text_metrics.hpp"

namespace strake::sheets {

namespace {

using Outline = std::vector<PaperPoint>;

/// Reads a path of PDF back as straight lines.
class OutlineReader {
 public:
  std::vector<Outline> read(std::string_view operators) {
    while (!operators.empty()) {
      const std::size_t end = operators.find_first_of(" \n");
      take(operators.substr(0, end));
      operators.remove_prefix(end == std::string_view::npos ? operators.size() : end + 1);
    }
    return std::move(outlines_);
  }

 private:
  void take(std::string_view token) {
    if (token.empty()) return;
    const char letter = token.front();
    if (token.size() > 1 || letter < 'a') {
      double value = 0;
      std::from_chars(token.data(), token.data() + token.size(), value);
      numbers_.push_back(value);
      return;
    }
    const auto point = [&](std::size_t i) {
      return PaperPoint{numbers_.at(2 * i), numbers_.at(2 * i + 1)};
    };
    if (letter == 'm') {
      outlines_.push_back({point(0)});
    } else if (!outlines_.empty()) {
      Outline& outline = outlines_.back();
      if (letter == 'l') outline.push_back(point(0));
      if (letter == 'c') add_curve(outline, point(0), point(1), point(2));
      if (letter == 'h') outline.push_back(outline.front());
    }
    numbers_.clear();
  }

  /// Adds as many chords as keep within 0.01 mm of the curve.
  static void add_curve(Outline& outline, const PaperPoint& b, const PaperPoint& c,
                        const PaperPoint& d) {
    const PaperPoint a = outline.back();
    const auto bend = [](const PaperPoint& p, const PaperPoint& q, const PaperPoint& r) {
      return std::hypot(p.x - 2 * q.x + r.x, p.y - 2 * q.y + r.y);
    };
    constexpr double kWithinMm = 0.01;
    const double largest = std::max(bend(a, b, c), bend(b, c, d));
    const int chords =
        static_cast<int>(std::clamp(std::ceil(std::sqrt(0.75 * largest / kWithinMm)), 1.0, 1000.0));
    for (int i = 1; i < chords; ++i) {
      const double t = static_cast<double>(i) / chords, s = 1 - t;
      const std::array weights{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
      outline.push_back(
          {weights[0] * a.x + weights[1] * b.x + weights[2] * c.x + weights[3] * d.x,
           weights[0] * a.y + weights[1] * b.y + weights[2] * c.y + weights[3] * d.y});
    }
    outline.push_back(d);
  }

  std::vector<double> numbers_;
  std::vector<Outline> outlines_;
};

class DxfCanvas final : public ArtworkCanvas {
 public:
  DxfCanvas(drawing::dxf::PaperSpace& paper, std::size_t layer) : paper_(paper), layer_(layer) {}

  [[nodiscard]] double width_of(const std::string& text) override {
    std::string_view rest = text;
    double width = 0;
    while (!rest.empty()) width += widths_.of(decode_character(rest));
    return width;
  }

  void paint(const PathBuilder& path, const SvgStyle& style, double scale,
             ReportUnsupported report) override {
    const std::vector<Outline> outlines = OutlineReader().read(path.operators());
    if (style.fill && path.has_inside()) {
      if (outlines.size() > 1) report("what lies within filled paths");
      paper_.use_pen({{*style.fill, 0}});
      paper_.add_filled(layer_, outlines.front());
    }
    if (style.stroke && style.stroke_width > 0) {
      if (!style.dashes.empty()) report("stroke-dasharray");
      paper_.use_pen({{*style.stroke, style.stroke_width * scale}});
      for (const Outline& outline : outlines) paper_.add_lines(layer_, outline);
    }
    paper_.use_pen({});
  }

  void write(const ArtworkText& text) override {
    const Align align = text.anchored ? text.style.anchor : Align::start;
    const double share = align == Align::start ? 0 : align == Align::middle ? 0.5 : 1;
    std::optional<drawing::dxf::TextPlace> place = place_of(text.to_paper);
    if (!place) return;
    place->at = text.to_paper(share * text.width, 0);
    place->align = dxf_align_of(align);
    paper_.use_pen({{*text.style.fill, 0}});
    paper_.add_text(layer_, *place, text.text);
    paper_.use_pen({});
  }

 private:
  /// Returns how a text stands but for its point: turned after it was mirrored, after it was made
  /// to lean, no more than TEXT may, after it was stretched, which every transform is. Nothing for
  /// one that is squeezed to a line.
  static std::optional<drawing::dxf::TextPlace> place_of(const Affine& m) {
    constexpr double kMaxDegrees = 85;
    // Along the base line and upwards, where y points up.
    const double det = m.b * m.c - m.a * m.d;
    const double side = det < 0 ? -1 : 1;
    const double along = std::hypot(m.a, m.b);
    if (!(std::fabs(det) > 0 && along > 0)) return std::nullopt;
    const double x = side * m.a / along, y = -side * m.b / along;
    const double height = std::fabs(det) / along, lean = side * (x * m.c - y * m.d);
    const auto degrees = [](double opposite, double adjacent) {
      const double angle = geometry::arc_tan2(opposite, adjacent) * 180 / geometry::kPi;
      return std::round(angle * 1e6) / 1e6 + 0.0;
    };
    drawing::dxf::TextPlace place;
    place.height = std::round(height / kFontSize * 1e3) / 1e3;
    place.turn_deg = degrees(y, x);
    place.stretch = std::round(along / height * 1e6) / 1e6;
    place.lean_deg = degrees(lean, height);
    place.mirrored = side < 0;
    if (!(place.height > 0)) return std::nullopt;
    place.lean_deg = std::clamp(place.lean_deg, -kMaxDegrees, kMaxDegrees);
    return place;
  }

  drawing::dxf::PaperSpace& paper_;
  std::size_t layer_;
  drawing::LetterWidths widths_;
};

}  // namespace

drawing::dxf::TextAlign dxf_align_of(Align align) {
  return align == Align::start    ? drawing::dxf::TextAlign::start
         : align == Align::middle ? drawing::dxf::TextAlign::middle
                                  : drawing::dxf::TextAlign::end;
}

Status add_dxf_artwork(drawing::dxf::PaperSpace& paper, std::size_t layer, const Sheet& sheet,
                       Diagnostics& diagnostics) {
  DxfCanvas canvas(paper, layer);
  return draw_artwork(canvas, *sheet.artwork, {sheet.width_mm, sheet.height_mm}, "DXF",
                      diagnostics);
}

}  // namespace strake::sheets
