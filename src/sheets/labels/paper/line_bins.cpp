// SPDX-License-Identifier: Apache-2.0
#include "sheets/labels/paper/line_bins.hpp"

#include <algorithm>
#include <cmath>

namespace strake::sheets {

namespace {

constexpr double kLineBinMm = 8;

std::size_t bins_of(double mm) {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(mm / kLineBinMm)));
}

std::size_t bin_at(double mm, std::size_t count) {
  return static_cast<std::size_t>(
      std::clamp(std::floor(mm / kLineBinMm), 0.0, static_cast<double>(count - 1)));
}

}  // namespace

LineBins::LineBins(double width_mm, double height_mm)
    : paper_{0, 0, width_mm, height_mm},
      columns_(bins_of(width_mm)),
      rows_(bins_of(height_mm)),
      bins_(columns_ * rows_) {}

/// Calls visit(bin) for the bins of a box until it returns true; returns whether it did.
template <class Visit>
bool LineBins::each_bin(const PaperBox& box, Visit&& visit) const {
  const std::size_t right = bin_at(box.right, columns_), bottom = bin_at(box.bottom, rows_);
  for (std::size_t r = bin_at(box.top, rows_); r <= bottom; ++r)
    for (std::size_t c = bin_at(box.left, columns_); c <= right; ++c)
      if (visit(r * columns_ + c)) return true;
  return false;
}

void LineBins::add(const PaperSegment& line) {
  const auto visible = clipped(line, paper_);
  if (!visible) return;
  const auto number = static_cast<std::uint32_t>(lines_.size());
  lines_.push_back(*visible);
  const auto [top, bottom] = std::minmax(visible->a.y, visible->b.y);
  for (std::size_t r = bin_at(top, rows_); r <= bin_at(bottom, rows_); ++r) {
    // Of each row the bins beside the part of the line that lies in it; a little more for rounding.
    constexpr double kRim = 0.01;
    const double from = static_cast<double>(r) * kLineBinMm;
    const auto part =
        clipped(*visible, {paper_.left, from - kRim, paper_.right, from + kLineBinMm + kRim});
    if (!part) continue;
    const auto [left, right] = std::minmax(part->a.x, part->b.x);
    each_bin({left - kRim, from + kLineBinMm / 2, right + kRim, from + kLineBinMm / 2},
             [&](std::size_t bin) {
               bins_[bin].push_back(number);
               return false;
             });
  }
}

bool LineBins::any_in(const TurnedBox& box) const {
  const auto& [middle, way, half_length, half_height] = box;
  const double x = std::fabs(way.x) * half_length + std::fabs(way.y) * half_height,
               y = std::fabs(way.y) * half_length + std::fabs(way.x) * half_height;
  const PaperBox level{-half_length, -half_height, half_length, half_height};
  // Points in the frame of the box, with its middle at the origin.
  const auto turned = [&](const PaperPoint& p) {
    const double dx = p.x - middle.x, dy = p.y - middle.y;
    return PaperPoint{dx * way.x + dy * way.y, dy * way.x - dx * way.y};
  };
  return each_bin({middle.x - x, middle.y - y, middle.x + x, middle.y + y}, [&](std::size_t bin) {
    return std::ranges::any_of(bins_[bin], [&](std::uint32_t number) {
      const PaperSegment& line = lines_[number];
      return clipped({turned(line.a), turned(line.b)}, level).has_value();
    });
  });
}

}  // namespace strake::sheets
