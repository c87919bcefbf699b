// SPDX-License-Identifier: Apache-2.0
#include "sheets/annotation/sheet_notes.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "core/number.hpp"
#include "drawing/layout/view_plane.hpp"

namespace strake::sheets {

namespace {

using drawing::rounded_paper;

constexpr double kLongestBarMm = 80, kBarMm = 1.5, kNumberMm = 2.5;

/// A round length, and into how many parts it falls.
struct BarLength {
  double mm = 1;
  int parts = 5;
};

/// Returns the largest of 1, 2, 5, 10 … and their tenths that is no longer.
BarLength round_length(double max_mm) {
  double decade = 1e-3;
  while (decade * 10 <= max_mm) decade *= 10;
  if (decade * 5 <= max_mm) return {decade * 5, 5};
  if (decade * 2 <= max_mm) return {decade * 2, 4};
  return {decade, 5};
}

/// Rounds off what the tenths leave in the last digits.
std::string number_text(double value) { return shortest(std::round(value * 1e6) / 1e6); }

}  // namespace

void draw_scale_bar(const PaperPoint& upper_left, double scale, Marks& marks) {
  const BarLength bar = round_length(kLongestBarMm * scale);
  const bool metres = bar.mm >= 1000;
  const double part = bar.mm / bar.parts / scale;
  const double left = upper_left.x + 2, top = upper_left.y + kNumberMm + 1;
  const auto at = [&](double x, double y) {
    return PaperPoint{rounded_paper(left + x), rounded_paper(top + y)};
  };
  for (int k = 0; k <= bar.parts; ++k) {
    std::string text = number_text(bar.mm * k / bar.parts / (metres ? 1000 : 1));
    if (k == bar.parts) text += metres ? " m" : " mm";
    marks.texts.push_back({LineClass::note, at(part * k, -1), kNumberMm,
                           k == bar.parts ? Align::start : Align::middle, text, false});
    if (k == bar.parts) break;
    const double from = part * k, to = part * (k + 1);
    Path box{LineClass::note,
             {at(from, 0), at(to, 0), at(to, kBarMm), at(from, kBarMm), at(from, 0)},
             false};
    // What is filled has an outline too, or it would look shorter than the others.
    marks.paths.push_back(box);
    box.filled = true;
    if (k % 2 == 0) marks.paths.push_back(std::move(box));
  }
}

bool shows_direction(const hlr::View& view, const geometry::Vec3l& direction) {
  if (view.perspective) return false;
  const auto axes = drawing::paper_axes(view);
  const geometry::Vec3d way = direction.as<double>();
  const double along = axes ? dot(axes->toward, way) : 0;
  return axes && along * along < 0.25 * dot(way, way);
}

void draw_north(const PaperPoint& middle, const hlr::View& view, const geometry::Vec3l& direction,
                Marks& marks) {
  const auto axes = drawing::paper_axes(view);
  if (!axes) return;
  const geometry::Vec3d way = direction.as<double>();
  PaperPoint to{dot(axes->right, way), -dot(axes->up, way)};
  const double length = std::sqrt(to.x * to.x + to.y * to.y);
  if (!(length > 0)) return;
  to = {to.x / length, to.y / length};
  constexpr double kRadius = 5, kHalfWidth = 1.8, kNotch = 2.5;
  const auto at = [&](double ahead, double aside) {
    return PaperPoint{rounded_paper(middle.x + to.x * ahead - to.y * aside),
                      rounded_paper(middle.y + to.y * ahead + to.x * aside)};
  };
  marks.circles.push_back({LineClass::note, at(0, 0), kRadius});
  // One half of the needle is filled.
  const PaperPoint tip = at(kRadius, 0), notch = at(-kNotch, 0);
  marks.paths.push_back({LineClass::note, {tip, at(-kRadius * 0.8, kHalfWidth), notch, tip}, true});
  marks.paths.push_back(
      {LineClass::note,
       {tip, at(-kRadius * 0.8, kHalfWidth), notch, at(-kRadius * 0.8, -kHalfWidth), tip},
       false});
  const PaperPoint letter = at(kRadius + 2.5, 0);
  constexpr double kLetterMm = 3.5;
  marks.texts.push_back({LineClass::note,
                         {letter.x, rounded_paper(letter.y + kLetterMm / 2)},
                         kLetterMm,
                         Align::middle,
                         "N",
                         false});
}

}  // namespace strake::sheets
