// SPDX-License-Identifier: Apache-2.0
#include "sheets/labels/paper/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sheets/spec/paper_segments.hpp"

namespace strake::sheets {

namespace {

std::size_t clamped(double cell, std::size_t count) {
  if (cell <= 0) return 0;
  return cell < static_cast<double>(count) ? static_cast<std::size_t>(cell) : count - 1;
}

/// Squares as multiples of 2^-32 of one: a walk adds them quickly, and up to rounding at its end
/// they stay on the sheet.
using FixedPoint = std::int64_t;
FixedPoint fixed_point(double squares) { return std::llround(squares * 4294967296.0); }

std::size_t whole(FixedPoint squares, std::size_t count) {
  return static_cast<std::size_t>(
      std::clamp<FixedPoint>(squares >> 32, 0, static_cast<FixedPoint>(count) - 1));
}

}  // namespace

OccupancyGrid::OccupancyGrid(double width_mm, double height_mm)
    : width_mm_(width_mm),
      height_mm_(height_mm),
      size_(std::max(1.0, std::sqrt(width_mm * height_mm) / 1500)),
      columns_(static_cast<std::size_t>(std::ceil(width_mm / size_))),
      rows_(static_cast<std::size_t>(std::ceil(height_mm / size_))),
      cells_(columns_ * rows_) {}

std::size_t OccupancyGrid::column(double x) const {
  return clamped(std::floor(x / size_), columns_);
}

std::size_t OccupancyGrid::row(double y) const { return clamped(std::floor(y / size_), rows_); }

/// Calls `take` with the square of each step of at most half a square from a to b, as far as the
/// line runs on the sheet and `take` returns true: each point of what it ran along is within a
/// quarter of a square of one that is taken.
template <class Take>
void OccupancyGrid::walk(const PaperPoint& a, const PaperPoint& b, Take&& take) const {
  const auto visible = clipped({a, b}, {0, 0, width_mm_, height_mm_});
  if (!visible) return;
  const double dx = (visible->b.x - visible->a.x) / size_,
               dy = (visible->b.y - visible->a.y) / size_;
  const double steps = std::max(1.0, std::ceil(std::sqrt(dx * dx + dy * dy) * 2));
  const FixedPoint by_x = fixed_point(dx / steps), by_y = fixed_point(dy / steps);
  FixedPoint x = fixed_point(visible->a.x / size_) + by_x / 2,
             y = fixed_point(visible->a.y / size_) + by_y / 2;
  for (double i = 0; i < steps; ++i, x += by_x, y += by_y)
    if (!take(whole(y, rows_) * columns_ + whole(x, columns_))) return;
}

void OccupancyGrid::add_line(const PaperPoint& a, const PaperPoint& b) {
  walk(a, b, [&](std::size_t cell) {
    if (cells_[cell] == Occupancy::no) cells_[cell] = Occupancy::by_line;
    return true;
  });
}

void OccupancyGrid::block(const PaperBox& box) {
  if (!box.overlaps({0, 0, width_mm_, height_mm_})) return;
  for (std::size_t r = row(box.top); r <= row(box.bottom); ++r)
    for (std::size_t c = column(box.left); c <= column(box.right); ++c)
      cells_[r * columns_ + c] = Occupancy::blocked;
}

void OccupancyGrid::finish() {
  const std::size_t across = columns_ + 1;
  taken_before_.assign(across * (rows_ + 1), 0);
  for (std::size_t r = 0; r < rows_; ++r)
    for (std::size_t c = 0; c < columns_; ++c)
      taken_before_[(r + 1) * across + c + 1] =
          taken_before_[r * across + c + 1] + taken_before_[(r + 1) * across + c] -
          taken_before_[r * across + c] + (cells_[r * columns_ + c] == Occupancy::no ? 0U : 1U);
}

bool OccupancyGrid::is_free(const PaperBox& box) const {
  // Of a line within the clearance, a step is within a quarter of a square more.
  const PaperBox wide = widened(box, kClearanceMm + size_ / 4);
  const std::size_t across = columns_ + 1;
  const std::size_t top = row(wide.top) * across, bottom = (row(wide.bottom) + 1) * across;
  const std::size_t left = column(wide.left), right = column(wide.right) + 1;
  return taken_before_[bottom + right] + taken_before_[top + left] ==
         taken_before_[bottom + left] + taken_before_[top + right];
}

OccupancyGrid::LeaderPath OccupancyGrid::leader_path(const PaperPoint& a,
                                                     const PaperPoint& b) const {
  LeaderPath path;
  walk(a, b, [&](std::size_t cell) {
    ++path.steps;
    path.open = cells_[cell] != Occupancy::blocked;
    if (cells_[cell] == Occupancy::by_line) ++path.lines;
    return path.open;
  });
  return path;
}

}  // namespace strake::sheets
