// SPDX-License-Identifier: Apache-2.0
#include "sheets/spec/text_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/text_encoding.hpp"
#include "drawing/lettering/lettering.hpp"
#include "geometry/numeric/trig.hpp"

namespace strake::sheets {

std::string on_one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  return text;
}

double text_width(std::string_view text) {
  const drawing::LetterWidths widths;
  double width = 0;
  while (!text.empty()) width += widths.of(decode_character(text));
  return width * kFontSize;
}

PaperBox box_of(const PaperPoint& at, Align align, double width_mm, double height_mm) {
  const double left = align == Align::start    ? at.x
                      : align == Align::middle ? at.x - width_mm / 2
                                               : at.x - width_mm;
  // A quarter of the height below the line for letters that hang.
  return {left, at.y - height_mm, left + width_mm, at.y + height_mm / 4};
}

PaperBox level_box_of(const Text& text) {
  return box_of(text.at, text.align, text_width(text.text) * text.height_mm, text.height_mm);
}

std::array<PaperPoint, 4> corners_of(const Text& text) {
  const PaperBox box = level_box_of(text);
  std::array<PaperPoint, 4> corners{
      {{box.left, box.bottom}, {box.right, box.bottom}, {box.right, box.top}, {box.left, box.top}}};
  if (text.turn_deg == 0) return corners;
  const auto turn = geometry::sin_cos(text.turn_deg * geometry::kPi / 180);
  for (PaperPoint& corner : corners) {
    const double x = corner.x - text.at.x, y = corner.y - text.at.y;
    corner = {text.at.x + x * turn.cos + y * turn.sin, text.at.y - x * turn.sin + y * turn.cos};
  }
  return corners;
}

namespace {

PaperBox box_round(std::span<const PaperPoint> points) {
  PaperBox box{points[0].x, points[0].y, points[0].x, points[0].y};
  for (const PaperPoint& p : points)
    box = {std::min(box.left, p.x), std::min(box.top, p.y), std::max(box.right, p.x),
           std::max(box.bottom, p.y)};
  return box;
}

}  // namespace

PaperBox box_of(const Text& text) {
  return text.turn_deg == 0 ? level_box_of(text) : box_round(corners_of(text));
}

std::vector<PaperBox> boxes_of(const Text& text) {
  if (text.turn_deg == 0 || text.turn_deg == 90) return {box_of(text)};
  const auto [a, b, c, d] = corners_of(text);
  const PaperBox level = level_box_of(text);
  const double parts = std::clamp(std::ceil(level.width() / level.height()), 1.0, 1000.0);
  const auto between = [](const PaperPoint& p, const PaperPoint& q, double t) {
    return PaperPoint{p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t};
  };
  std::vector<PaperBox> boxes;
  for (double i = 0; i < parts; ++i) {
    const double from = i / parts, to = (i + 1) / parts;
    boxes.push_back(box_round(std::array{between(a, b, from), between(a, b, to),
                                         between(d, c, from), between(d, c, to)}));
  }
  return boxes;
}

Text shrunk_to_width(Text text, double width_mm, double min_height) {
  const double wide = text_width(text.text) * text.height_mm;
  if (wide > width_mm) text.height_mm = std::max(min_height, text.height_mm * width_mm / wide);
  return text;
}

Text cut_to_width(Text text, double width_mm) {
  if (text_width(text.text) * text.height_mm <= width_mm) return text;
  constexpr std::string_view kEllipsis = "\xE2\x80\xA6";
  const double room = width_mm / text.height_mm - text_width(kEllipsis);
  const drawing::LetterWidths widths;
  std::string_view rest = text.text;
  double width = 0;
  std::size_t kept = 0;
  while (!rest.empty()) {
    width += widths.of(decode_character(rest)) * kFontSize;
    if (width > room) break;
    kept = text.text.size() - rest.size();
  }
  text.text = text.text.substr(0, kept) + std::string(kEllipsis);
  return text;
}

}  // namespace strake::sheets
