// SPDX-License-Identifier: Apache-2.0
#include "pictures/viewpoint/window.hpp"

#include <tuple>
#include <utility>

namespace strake::pictures {
namespace {

using geometry::Box3d;
using geometry::Vec3d;

WindowPoint window_point(const Window& w, const Vec3d& p) {
  return {(dot(p, w.axes.right) / w.half_width_mm + 1) * 0.5 * w.columns,
          (1 - dot(p, w.axes.up) / w.half_height_mm) * 0.5 * w.rows, dot(p, w.axes.toward)};
}

Vec3d model_point(const Window& w, const WindowPoint& p) {
  return w.axes.right * ((2 * p.x / w.columns - 1) * w.half_width_mm) +
         w.axes.up * ((1 - 2 * p.y / w.rows) * w.half_height_mm) + w.axes.toward * p.depth;
}

/// Half of what a box takes along an axis.
double half_along(const Vec3d& axis, const Vec3d& half) {
  return std::fabs(axis.x) * half.x + std::fabs(axis.y) * half.y + std::fabs(axis.z) * half.z;
}

/// Returns the least and the greatest of three numbers.
std::pair<double, double> range(double a, double b, double c) {
  return {std::min(std::min(a, b), c), std::max(std::max(a, b), c)};
}

/// Returns a number cut to 0 to `limit`.
double within(double value, std::uint32_t limit) {
  return std::clamp(value, 0.0, static_cast<double>(limit));
}

/// Returns the first and the end of the cells whose middles lie in a range.
std::array<std::uint32_t, 2> cells(double least, double limit, std::uint32_t count) {
  // Conversion cuts the fraction off, and costs less than rounding does.
  const double from = within(least - 0.5, count);
  const auto first = static_cast<std::uint32_t>(from);
  return {first < from ? first + 1 : first, static_cast<std::uint32_t>(within(limit + 0.5, count))};
}

/// The share of the corner opposite to the edge from a to b.
Slope share_of(const WindowPoint& a, const WindowPoint& b, double per_area) {
  const double along = (a.y - b.y) * per_area, down = (b.x - a.x) * per_area;
  return {-(a.x * along + a.y * down), along, down};
}

/// What rounding takes from a share: neighbours leave no gap between them.
constexpr double kOnEdge = -1e-9;

}  // namespace

WindowRange range_of(const Window& w, const Box3d& box) {
  // Rounding must not take what lies on the rim of a box out of it.
  constexpr double kRounding = 1e-3;
  const WindowPoint middle = window_point(w, (box.lo + box.hi) * 0.5);
  const Vec3d half = (box.hi - box.lo) * 0.5;
  const double x = half_along(w.axes.right, half) / w.half_width_mm * 0.5 * w.columns + kRounding;
  const double y = half_along(w.axes.up, half) / w.half_height_mm * 0.5 * w.rows + kRounding;
  const double depth = half_along(w.axes.toward, half) + kRounding;
  return {middle.x - x, middle.x + x,         middle.y - y,
          middle.y + y, middle.depth - depth, middle.depth + depth};
}

std::optional<ProjectedTriangle> project_triangle(const Window& w, const NearTriangle& triangle,
                                                  std::uint32_t number) {
  const WindowPoint a = window_point(w, triangle.at[0]), b = window_point(w, triangle.at[1]),
                    c = window_point(w, triangle.at[2]);
  ProjectedTriangle projected;
  std::tie(projected.farthest, projected.nearest) = range(a.depth, b.depth, c.depth);
  if (projected.farthest > w.eye_mm) return std::nullopt;
  std::tie(projected.left, projected.right) = range(a.x, b.x, c.x);
  if (projected.right < 0.5 || projected.left > w.columns - 0.5) return std::nullopt;
  const auto [top, bottom] = range(a.y, b.y, c.y);
  const auto [first, end] = cells(top, bottom, w.rows);
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (first >= end || area == 0) return std::nullopt;
  projected.shares = {share_of(b, c, 1 / area), share_of(c, a, 1 / area), share_of(a, b, 1 / area)};
  for (std::size_t k = 0; k < 3; ++k)
    if (const double along = projected.shares[k].along; along != 0)
      projected.per_along[k] = 1 / along;
  const auto mixed = [&](double Slope::* of) {
    return a.depth * (projected.shares[0].*of) + b.depth * (projected.shares[1].*of) +
           c.depth * (projected.shares[2].*of);
  };
  projected.depth = {mixed(&Slope::at), mixed(&Slope::along), mixed(&Slope::down)};
  projected.number = number;
  projected.first = first;
  projected.end = end;
  projected.own = triangle.role != Role::other;
  projected.back = area > 0;  // rows grow downwards: fronts turn clockwise
  projected.solid = triangle.solid;
  projected.may_be_cut = projected.nearest > w.eye_mm;
  return projected;
}

std::vector<ProjectedTriangle> project_triangles(const Window& w, const NearTriangles& triangles) {
  std::vector<ProjectedTriangle> out;
  for (const bool own : {false, true})
    for (const TriangleRun& run : triangles.runs(own)) {
      const WindowRange range = range_of(w, run.box);
      if (range.right < 0 || range.left > w.columns || range.bottom < 0 || range.top > w.rows ||
          range.farthest > w.eye_mm || (w.box && !w.box->meets(run.box)))
        continue;
      const bool cut = may_cut(w, run.box);
      for (std::uint32_t i = run.first; i < run.end; ++i)
        if (std::optional<ProjectedTriangle> projected = project_triangle(w, triangles[i], i)) {
          projected->may_be_cut = projected->may_be_cut || cut;
          out.push_back(*projected);
        }
    }
  return out;
}

bool may_cut(const Window& w, const Box3d& box) {
  constexpr double kRounding = 1e-6;
  if (w.box && !w.box->inflated(-kRounding).contains(box)) return true;
  const Vec3d middle = (box.lo + box.hi) * 0.5, half = (box.hi - box.lo) * 0.5;
  return std::ranges::any_of(w.planes, [&](const ClippingPlane& plane) {
    return dot(middle - plane.point_mm, plane.normal) + half_along(plane.normal, half) > -kRounding;
  });
}

TriangleRow::TriangleRow(const Window& window, const ProjectedTriangle& triangle,
                         std::uint32_t row) {
  const double y = row + 0.5;
  double left = triangle.left, right = triangle.right;
  std::array<double, 3> at{};
  for (std::size_t k = 0; k < 3; ++k) {
    // Where the share is not negative, but for rounding.
    constexpr double kRounding = 0.01;
    const Slope& share = triangle.shares[k];
    at[k] = share.at + y * share.down;
    const double zero = -at[k] * triangle.per_along[k];
    if (share.along > 0)
      left = std::max(left, zero - kRounding);
    else if (share.along < 0)
      right = std::min(right, zero + kRounding);
    else if (at[k] < kOnEdge)
      return;
  }
  const auto [first, end] = cells(left, right, window.columns);
  first_ = first;
  end_ = end;
  // Shares go straight along a row: what lies between two points of a triangle is in it.
  const auto is_in = [&](std::uint32_t column) {
    const double x = column + 0.5;
    return std::min({at[0] + x * triangle.shares[0].along, at[1] + x * triangle.shares[1].along,
                     at[2] + x * triangle.shares[2].along}) >= kOnEdge;
  };
  while (first_ < end_ && !is_in(first_)) ++first_;
  while (first_ < end_ && !is_in(end_ - 1)) --end_;
  if (first_ >= end_) return;
  depth_ = triangle.depth.of(first_ + 0.5, y);
  step_ = triangle.depth.along;
  farthest_ = triangle.farthest;
  nearest_ = triangle.nearest;
  if (triangle.may_be_cut) cut(window, row);
}

/// What the window leaves out is left out along a straight row from some column on, or up to it.
void TriangleRow::cut(const Window& w, std::uint32_t row) {
  const Vec3d at = model_point(w, {first_ + 0.5, row + 0.5, depth_});
  const Vec3d along = w.axes.right * (2 * w.half_width_mm / w.columns) + w.axes.toward * step_;
  double from = 0, to = static_cast<double>(end_ - first_) - 1;
  // Keeps the columns where room + column * step is not negative.
  const auto keep = [&](double room, double step) {
    if (step > 0)
      from = std::max(from, -room / step);
    else if (step < 0)
      to = std::min(to, -room / step);
    else if (room < 0)
      to = -1;
  };
  keep(w.eye_mm - depth_, -step_);
  if (w.box)
    for (int k = 0; k < 3; ++k) {
      keep(at[k] - w.box->lo[k], along[k]);
      keep(w.box->hi[k] - at[k], -along[k]);
    }
  for (const ClippingPlane& plane : w.planes)
    keep(-dot(at - plane.point_mm, plane.normal), -dot(along, plane.normal));
  const std::uint32_t count = end_ - first_;
  if (to < 0 || from > to) {
    end_ = first_;
    return;
  }
  const auto [skipped, kept] = cells(from + 0.5, to + 0.5, count);
  depth_ += step_ * skipped;
  end_ = first_ + kept;
  first_ = std::min(first_ + skipped, end_);
}

}  // namespace strake::pictures
