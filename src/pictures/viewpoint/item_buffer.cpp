// SPDX-License-Identifier: Apache-2.0
#include "pictures/viewpoint/item_buffer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace strake::pictures {
namespace {

using geometry::Vec3d;

/// A point in the window: columns from the left, rows from above, mm towards the viewer.
struct WindowPoint {
  double x = 0, y = 0, depth = 0;
};

WindowPoint seen(const Window& w, const Vec3d& p) {
  return {(dot(p, w.axes.right) / w.half_width_mm + 1) * 0.5 * w.columns,
          (1 - dot(p, w.axes.up) / w.half_height_mm) * 0.5 * w.rows, dot(p, w.axes.toward)};
}

double turn(const WindowPoint& a, const WindowPoint& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

bool is_cut_away(const Window& w, const Vec3d& p) {
  if (w.box && !w.box->meets({p, p})) return true;
  return std::ranges::any_of(w.planes, [&](const ClippingPlane& plane) {
    return dot(p - plane.point_mm, plane.normal) > 0;
  });
}

/// Returns the first and the end of the cells whose middles lie in a range.
std::array<std::uint32_t, 2> cells(double least, double most, std::uint32_t count) {
  const double end = count;
  return {static_cast<std::uint32_t>(std::clamp(std::ceil(least - 0.5), 0.0, end)),
          static_cast<std::uint32_t>(std::clamp(std::floor(most - 0.5) + 1, 0.0, end))};
}

}  // namespace

ItemBuffer::ItemBuffer(const Window& window, std::span<const NearTriangle> triangles)
    : columns_(window.columns), items_(std::size_t{window.columns} * window.rows) {
  for (std::size_t i = 0; i < triangles.size(); ++i)
    add(window, static_cast<std::uint32_t>(i), triangles[i]);
}

void ItemBuffer::add(const Window& w, std::uint32_t number, const NearTriangle& triangle) {
  const WindowPoint a = seen(w, triangle.at[0]), b = seen(w, triangle.at[1]),
                    c = seen(w, triangle.at[2]);
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  if (std::min({a.depth, b.depth, c.depth}) > w.eye_mm) return;
  const double area = turn(a, b, c.x, c.y);
  if (area == 0) return;
  const auto [first_row, end_row] = cells(top, bottom, w.rows);
  const auto [first_column, end_column] = cells(left, right, w.columns);
  const bool clipped = w.box || !w.planes.empty();
  for (std::uint32_t row = first_row; row < end_row; ++row)
    for (std::uint32_t column = first_column; column < end_column; ++column) {
      const double x = column + 0.5, y = row + 0.5;
      const double u = turn(b, c, x, y) / area, v = turn(c, a, x, y) / area, r = 1 - u - v;
      if (u < 0 || v < 0 || r < 0) continue;
      const double depth = u * a.depth + v * b.depth + r * c.depth;
      Item& item = items_[std::size_t{row} * columns_ + column];
      if (depth <= item.depth || depth > w.eye_mm) continue;
      if (clipped && is_cut_away(w, triangle.at[0] * u + triangle.at[1] * v + triangle.at[2] * r))
        continue;
      item = {number, area > 0, depth};  // rows grow downwards: fronts turn clockwise there
    }
}

}  // namespace strake::pictures
