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

/// A share of a triangle's corner as a point of the window goes: at + x * step along a row.
struct Share {
  double at = 0, step = 0;

  /// Narrows the part of a row where the share is not negative, but for rounding.
  void narrow(double& left, double& right) const {
    constexpr double kRounding = 0.01;
    if (step > 0)
      left = std::max(left, -at / step - kRounding);
    else if (step < 0)
      right = std::min(right, -at / step + kRounding);
    else if (at < 0)
      right = left - 1;
  }
};

/// The share of the corner opposite to the edge from a to b, along the row y.
Share share_of(const WindowPoint& a, const WindowPoint& b, double y, double per_area) {
  return {((b.x - a.x) * (y - a.y) + (b.y - a.y) * a.x) * per_area, (a.y - b.y) * per_area};
}

/// What rounding takes from a share: neighbours leave no gap between them.
constexpr double kOnEdge = -1e-9;

/// Faces nearer to each other than this are one: rounding must not tell them apart.
constexpr double kSameDepthMm = 0.02;

/// Puts a face where it is nearer than what is there.
void keep_nearest(ItemBuffer::Item& item, const ItemBuffer::Item& found, bool preferred) {
  const double ahead = preferred ? -kSameDepthMm : kSameDepthMm;
  if (found.depth > item.depth + ahead) item = found;
}

}  // namespace

ItemBuffer::ItemBuffer(const Window& window, std::span<const NearTriangle> triangles)
    : columns_(window.columns), items_(std::size_t{window.columns} * window.rows) {
  if (!window.planes.empty()) own_.resize(items_.size());
  for (const bool own : {false, true})  // the clash's own last, which win where depths are equal
    for (std::size_t i = 0; i < triangles.size(); ++i)
      if ((triangles[i].role != Role::other) == own)
        add(window, static_cast<std::uint32_t>(i), triangles[i]);
  if (!own_.empty()) close_cuts(triangles);
}

void ItemBuffer::close_cuts(std::span<const NearTriangle> triangles) {
  for (std::size_t i = 0; i < items_.size(); ++i)
    if (const Item& own = own_[i];
        own.triangle != kNothing && own.back && triangles[own.triangle].solid)
      items_[i] = own;
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
  const double per_area = 1 / area;
  const bool clipped = w.box || !w.planes.empty(), own = triangle.role != Role::other;
  for (std::uint32_t row = first_row; row < end_row; ++row) {
    const Share of_a = share_of(b, c, row + 0.5, per_area);
    const Share of_b = share_of(c, a, row + 0.5, per_area);
    const Share of_c = share_of(a, b, row + 0.5, per_area);
    double from = left, to = right;
    for (const Share& share : {of_a, of_b, of_c}) share.narrow(from, to);
    const auto [first_column, end_column] = cells(from, to, w.columns);
    for (std::uint32_t column = first_column; column < end_column; ++column) {
      const double x = column + 0.5;
      const double u = of_a.at + x * of_a.step, v = of_b.at + x * of_b.step, r = 1 - u - v;
      if (std::min({u, v, r}) < kOnEdge) continue;
      const double depth = u * a.depth + v * b.depth + r * c.depth;
      const std::size_t at = std::size_t{row} * columns_ + column;
      if (depth > w.eye_mm || (depth < items_[at].depth - kSameDepthMm && own_.empty())) continue;
      if (clipped && is_cut_away(w, triangle.at[0] * u + triangle.at[1] * v + triangle.at[2] * r))
        continue;
      const Item found{number, area > 0, own, depth};  // rows grow downwards: fronts turn clockwise
      keep_nearest(items_[at], found, own && !items_[at].own);
      if (own && !own_.empty()) keep_nearest(own_[at], found, false);
    }
  }
}

}  // namespace strake::pictures
