// SPDX-License-Identifier: Apache-2.0
#include "cli/evaluate/published/sheet_pixels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace strake::cli {

namespace {

constexpr std::uint8_t kHidden = 1, kVisible = 2;

}  // namespace

SheetPixels::SheetPixels(const drawing::NeutralDrawing& sheet, const drawing::Ink& ink) {
  const double longer = std::max(sheet.sheet.width_mm, sheet.sheet.height_mm);
  if (!(longer > 0)) return;
  const double pixels_per_mm = static_cast<double>(kLongerSide) / longer;
  const auto pixels = [&](double mm) {
    return std::max<std::size_t>(static_cast<std::size_t>(std::lround(mm * pixels_per_mm)), 1);
  };
  width_ = pixels(sheet.sheet.width_mm);
  height_ = pixels(sheet.sheet.height_mm);
  ink_.resize(width_ * height_);
  for (const drawing::Line& line : ink.lines) draw(line, pixels_per_mm);
}

/// Inks a pixel for each step along the longer side of the line.
void SheetPixels::draw(const drawing::Line& line, double pixels_per_mm) {
  const std::uint8_t ink = line.state == drawing::LineState::visible ? kVisible : kHidden;
  const double x = line.a_paper.x * pixels_per_mm, y = line.a_paper.y * pixels_per_mm;
  const double dx = line.b_paper.x * pixels_per_mm - x, dy = line.b_paper.y * pixels_per_mm - y;
  const double length = std::max(std::fabs(dx), std::fabs(dy));
  // A line of the sheet has no more steps than the sheet has pixels along a side.
  const auto steps = length < static_cast<double>(kLongerSide)
                         ? static_cast<std::size_t>(std::ceil(length))
                         : std::size_t{kLongerSide};
  for (std::size_t i = 0; i <= steps; ++i) {
    const double t = steps == 0 ? 0 : static_cast<double>(i) / static_cast<double>(steps);
    const double column = std::floor(x + t * dx), row = std::floor(y + t * dy);
    if (!(column >= 0 && row >= 0 && column < static_cast<double>(width_) &&
          row < static_cast<double>(height_)))
      continue;
    std::uint8_t& pixel =
        ink_[static_cast<std::size_t>(row) * width_ + static_cast<std::size_t>(column)];
    pixel = std::max(pixel, ink);
  }
}

std::size_t SheetPixels::inked() const {
  return ink_.size() - static_cast<std::size_t>(std::ranges::count(ink_, 0));
}

std::size_t SheetPixels::different(const SheetPixels& other) const {
  if (width_ != other.width_ || height_ != other.height_)
    return std::max(ink_.size(), other.ink_.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < ink_.size(); ++i)
    if (ink_[i] != other.ink_[i]) ++count;
  return count;
}

std::string SheetPixels::difference_text(const SheetPixels& other) const {
  return fmt::format("{} of {} pixels differ", different(other),
                     std::max(ink_.size(), other.ink_.size()));
}

}  // namespace strake::cli
