// SPDX-License-Identifier: Apache-2.0
#include "sheets/annotation/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>

namespace strake::sheets {

namespace {

std::size_t clamped(double cell, std::size_t count) {
  if (cell <= 0) return 0;
  return cell < static_cast<double>(count) ? static_cast<std::size_t>(cell) : count - 1;
}

}  // namespace

OccupancyGrid::OccupancyGrid(double width_mm, double height_mm)
    : size_(std::max(1.0, std::sqrt(width_mm * height_mm) / 1500)),
      columns_(static_cast<std::size_t>(std::ceil(width_mm / size_))),
      rows_(static_cast<std::size_t>(std::ceil(height_mm / size_))),
      cells_(columns_ * rows_) {}

std::size_t OccupancyGrid::column(double x) const {
  return clamped(std::floor(x / size_), columns_);
}

std::size_t OccupancyGrid::row(double y) const { return clamped(std::floor(y / size_), rows_); }

/// Calls `take` with each square that half-millimetre steps from a to b reach, and the length of a
/// step.
template <class Take>
void OccupancyGrid::walk(const PaperPoint& a, const PaperPoint& b, Take&& take) const {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double length = std::sqrt(dx * dx + dy * dy);
  // A line that runs far off the sheet is not followed to its end.
  const double steps = std::min(std::ceil(length * 2 / size_), 1e5);
  for (double i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps;
    take(row(a.y + dy * t) * columns_ + column(a.x + dx * t), length / steps);
  }
}

template <class Take>
void OccupancyGrid::each(const PaperBox& box, Take&& take) const {
  for (std::size_t r = row(box.top); r <= row(box.bottom); ++r)
    for (std::size_t c = column(box.left); c <= column(box.right); ++c) take(r * columns_ + c);
}

void OccupancyGrid::add_line(const PaperPoint& a, const PaperPoint& b) {
  walk(a, b,
       [&](std::size_t cell, double length) { cells_[cell].ink += static_cast<float>(length); });
}

void OccupancyGrid::add_leader(const PaperPoint& a, const PaperPoint& b) {
  walk(a, b, [&](std::size_t cell, double) {
    cells_[cell].leaders = static_cast<std::uint16_t>(std::min(cells_[cell].leaders + 1, 1000));
  });
}

void OccupancyGrid::block(const PaperBox& box) {
  each(box, [&](std::size_t cell) { cells_[cell].blocked = true; });
}

bool OccupancyGrid::is_open(const PaperBox& box) const {
  bool open = true;
  each(box, [&](std::size_t cell) {
    open = open && !cells_[cell].blocked && cells_[cell].leaders == 0;
  });
  return open;
}

double OccupancyGrid::ink(const PaperBox& box) const {
  double sum = 0;
  each(box, [&](std::size_t cell) { sum += static_cast<double>(cells_[cell].ink); });
  return sum;
}

OccupancyGrid::LeaderPath OccupancyGrid::way(const PaperPoint& a, const PaperPoint& b) const {
  LeaderPath way;
  walk(a, b, [&](std::size_t cell, double) {
    way.open = way.open && !cells_[cell].blocked;
    if (cells_[cell].leaders > 0) ++way.crossed;
  });
  return way;
}

}  // namespace strake::sheets
