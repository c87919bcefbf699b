// SPDX-License-Identifier: Apache-2.0
#include "pictures/viewpoint/visibility_buffer.hpp"

#include <algorithm>
#include <cmath>

namespace strake::pictures {

VisibilityBuffer::VisibilityBuffer(const Window& window, const NearTriangles& triangles)
    : points_(window.columns), at_(std::size_t{window.columns} * window.rows) {
  for (const TriangleRun& run : triangles.runs(true))
    for (std::uint32_t i = run.first; i < run.end; ++i)
      if (const auto projected = project_triangle(window, triangles[i], i))
        add(window, *projected, triangles[i].role);
  bound();
}

void VisibilityBuffer::add(const Window& window, const ProjectedTriangle& triangle, Role role) {
  for (std::uint32_t row = triangle.first; row < triangle.end; ++row) {
    const TriangleRow in_row(window, triangle, row);
    Point* const points = at_.data() + std::size_t{row} * points_;
    for (std::uint32_t column = in_row.first(); column < in_row.end(); ++column) {
      const double depth = in_row.depth(column);
      if (depth <= points[column].depth + kSameDepthMm) continue;
      points[column] = {depth, role, window.closes_cuts && triangle.back && triangle.solid};
    }
  }
}

/// Finds where the two may be hidden.
void VisibilityBuffer::bound() {
  own_ = {1e300, -1e300, 1e300, -1e300, 1e300, -1e300};
  for (std::uint32_t row = 0; row < points_; ++row)
    for (std::uint32_t column = 0; column < points_; ++column) {
      const Point& point = at_[std::size_t{row} * points_ + column];
      if (point.role == Role::other || point.closed) continue;
      own_.left = std::min(own_.left, column + 0.5);
      own_.right = std::max(own_.right, column + 0.5);
      own_.top = std::min(own_.top, row + 0.5);
      own_.bottom = std::max(own_.bottom, row + 0.5);
      own_.farthest = std::min(own_.farthest, point.depth);
    }
}

bool VisibilityBuffer::may_hide(const WindowRange& range) const {
  return range.nearest > own_.farthest && range.left <= own_.right && range.right >= own_.left &&
         range.top <= own_.bottom && range.bottom >= own_.top;
}

void VisibilityBuffer::cover(const Window& window, const NearTriangles& triangles) {
  for (const TriangleRun& run : triangles.runs(false)) {
    const WindowRange range = range_of(window, run.box);
    if (range.farthest > window.eye_mm || !may_hide(range)) continue;
    for (std::uint32_t i = run.first; i < run.end; ++i)
      if (const auto projected = project_triangle(window, triangles[i], i))
        cover(window, *projected);
  }
}

void VisibilityBuffer::cover(const Window& window, const ProjectedTriangle& triangle) {
  if (triangle.nearest <= own_.farthest) return;
  for (std::uint32_t row = triangle.first; row < triangle.end; ++row) {
    const TriangleRow in_row(window, triangle, row);
    Point* const points = at_.data() + std::size_t{row} * points_;
    for (std::uint32_t column = in_row.first(); column < in_row.end(); ++column) {
      Point& point = points[column];
      if (point.role == Role::other || point.closed) continue;
      if (in_row.depth(column) > point.depth + kSameDepthMm) point.role = Role::other;
    }
  }
}

VisibleShares VisibilityBuffer::shares() const {
  const double middle = points_ * 0.5, disc = middle * middle, round_point = points_ / 9.0;
  std::uint32_t in_disc = 0, of_a = 0, of_b = 0, at_point = 0, both_at_point = 0;
  for (std::uint32_t row = 0; row < points_; ++row)
    for (std::uint32_t column = 0; column < points_; ++column) {
      const double x = column + 0.5 - middle, y = row + 0.5 - middle, square = x * x + y * y;
      if (square > disc) continue;
      const Role role = at_[std::size_t{row} * points_ + column].role;
      ++in_disc;
      of_a += role == Role::a ? 1 : 0;
      of_b += role == Role::b ? 1 : 0;
      if (square > round_point * round_point) continue;
      ++at_point;
      both_at_point += role != Role::other ? 1 : 0;
    }
  const auto share = [](std::uint32_t part, std::uint32_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
  };
  return {share(of_a, in_disc), share(of_b, in_disc), share(both_at_point, at_point)};
}

}  // namespace strake::pictures
