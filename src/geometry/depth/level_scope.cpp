// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/level_scope.hpp"

#include <algorithm>

#include "geometry/box.hpp"

namespace strake::geometry {

CellHull::CellHull(const LevelCell& cell, double slack)
    : cell_(cell), slack_(slack), box_(box_of(cell.corners).inflated(slack)) {
  const auto& p = cell.corners;
  const Vec3d normal = cross(p[1] - p[0], p[2] - p[0]);
  if (const double size = length(normal); size > 0) up_ = normal * (1 / size);
  for (const Vec3d& q : p) along_up_.include(dot(up_, q));
}

bool CellHull::is_clearly_apart(const PreparedTriangle& triangle) const {
  const Corners& c = triangle.corners;
  for (int k = 0; k < 3; ++k)
    if (std::min({c[0][k], c[1][k], c[2][k]}) > box_.hi[k] ||
        std::max({c[0][k], c[1][k], c[2][k]}) < box_.lo[k])
      return true;
  const double x = dot(up_, c[0]), y = dot(up_, c[1]), z = dot(up_, c[2]);
  if (std::min({x, y, z}) - along_up_.hi > slack_ || along_up_.lo - std::max({x, y, z}) > slack_)
    return true;
  Range r;
  for (const Vec3d& p : cell_.corners) r.include(dot(triangle.unit, p));
  return r.lo - triangle.hi > slack_ || triangle.lo - r.hi > slack_;
}

bool CellHull::goes_through(const PreparedTriangle& triangle) const {
  const Vec3d line = cross(triangle.unit, up_);
  const auto chord = [&](std::span<const Vec3d> corners, const Vec3d& normal, double offset) {
    Range r;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3d &p = corners[i], &q = corners[i + 1 == corners.size() ? 0 : i + 1];
      const double at_p = dot(normal, p) - offset, at_q = dot(normal, q) - offset;
      if ((at_p < 0) != (at_q < 0)) r.include(dot(line, p + (q - p) * (at_p / (at_p - at_q))));
    }
    return r;
  };
  const Range own = chord(cell_.corners, triangle.unit, triangle.lo);
  const Range other = chord(triangle.corners, up_, along_up_.lo);
  return own.lo < other.hi && other.lo < own.hi;
}

bool is_outside(const DepthField& field, const CellHull& cell, const Vec3d& middle,
                PairWork& work) {
  return field.for_near(cell.corners(), cell.slack(), [&](std::uint32_t t) {
    const PreparedTriangle triangle = field.placed_triangle(t);
    return cell.is_clearly_apart(triangle) || cell.is_apart(triangle);
  }) && !field.contains(middle, work);
}

PartScope::About PartScope::look(const CellHull& cell, const About& from, const Vec3d& middle,
                                 std::vector<Corners>& crossing, PairWork& work) {
  if (from.known && from.side != Side::both) return from;
  About before = from;
  if (!from.known) before.last = read(cell);
  list_.resize(before.last);
  About about{.first = before.last, .known = true};
  const std::size_t others = crossing.size();
  for (std::uint32_t i = before.first; i < before.last; ++i) {
    const PreparedTriangle& triangle = triangles_[list_[i]];
    const bool many = crossing.size() - others > kMostCrossing;
    if (cell.is_clearly_apart(triangle) || (!many && cell.is_apart(triangle))) continue;
    if (!many) crossing.push_back(triangle.corners);
    list_.push_back(list_[i]);
  }
  about.last = static_cast<std::uint32_t>(list_.size());
  if (about.first == about.last)
    about.side = field_.contains(middle, work) ? Side::inside : Side::outside;
  return about;
}

std::uint32_t PartScope::read(const CellHull& cell) {
  triangles_.clear();
  list_.clear();
  field_.for_near(cell.corners(), cell.slack(), [&](std::uint32_t t) {
    list_.push_back(static_cast<std::uint32_t>(triangles_.size()));
    triangles_.push_back(field_.placed_triangle(t));
    return true;
  });
  return static_cast<std::uint32_t>(list_.size());
}

}  // namespace strake::geometry
