// SPDX-License-Identifier: Apache-2.0
#include "geometry/interior_depth/level_search/offset_cell.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

/// How far a sphere or cylinder about the points stands out of the hull of a cell's corners.
double bulge(const OffsetCell& cell) {
  const double radius = length(cell.corners[0] - cell.about[0]);
  if (cell.corners.size() == 4) {
    const double half = length(cell.corners[1] - cell.corners[0]) / 2;
    return radius - std::sqrt(std::max(radius * radius - half * half, 0.0));
  }
  const Vec3d n = cross(cell.corners[1] - cell.corners[0], cell.corners[2] - cell.corners[0]);
  const double size = length(n);
  if (!(size > 0)) return radius;
  return radius - std::fabs(dot(n, cell.corners[0] - cell.about[0])) / size;
}

OffsetCell curved(std::vector<Vec3d> corners, std::vector<Vec3d> about) {
  OffsetCell cell{.corners = std::move(corners), .about = std::move(about)};
  cell.slack = bulge(cell);
  return cell;
}

/// Half way between two corners, on the curved surface.
Vec3d between(const OffsetCell& cell, std::size_t i, std::size_t j, const Vec3d& about) {
  const Vec3d p = cell.corners[i] - cell.about[i], q = cell.corners[j] - cell.about[j];
  return about + unit(p + q) * length(p);
}

/// The corners of a cell that goes round an edge: 0 and 1 at one end, 3 and 2 at the other.
std::array<OffsetCell, 2> halves_round_edge(const OffsetCell& cell) {
  const auto& [p, about, slack, on_surface] = cell;
  const Vec3d near = between(cell, 0, 1, about[0]), far = between(cell, 3, 2, about[3]);
  return {curved({p[0], near, far, p[3]}, about), curved({near, p[1], p[2], far}, about)};
}

std::array<OffsetCell, 2> halves_round_corner(const OffsetCell& cell) {
  const auto& p = cell.corners;
  std::size_t longest = 0;
  double largest = -1;
  for (std::size_t i = 0; i < 3; ++i)
    if (const double size = length(p[(i + 1) % 3] - p[i]); size > largest) {
      largest = size;
      longest = i;
    }
  const std::size_t i = longest, j = (i + 1) % 3, k = (i + 2) % 3;
  const Vec3d middle = between(cell, i, j, cell.about[0]);
  return {curved({p[i], middle, p[k]}, cell.about), curved({middle, p[j], p[k]}, cell.about)};
}

}  // namespace

Vec3d middle_of(const OffsetCell& cell) {
  Vec3d sum;
  for (const Vec3d& p : cell.corners) sum = sum + p;
  return sum * (1 / static_cast<double>(cell.corners.size()));
}

double radius_of(const OffsetCell& cell, const Vec3d& from) {
  double largest = 0;
  for (const Vec3d& p : cell.corners) largest = std::max(largest, dot(p - from, p - from));
  return std::sqrt(largest);
}

OffsetCell flat_cell(const Corners& triangle, const Vec3d& way) {
  return {.corners = {triangle[0] + way, triangle[1] + way, triangle[2] + way}, .about = {}};
}

OffsetCell round_edge(const std::array<Vec3d, 2>& edge, const std::array<Vec3d, 2>& ways,
                      double distance) {
  const auto& [p, q] = edge;
  const Vec3d first = ways[0] * distance, last = ways[1] * distance;
  return curved({p + first, p + last, q + last, q + first}, {p, p, q, q});
}

OffsetCell round_corner(const Vec3d& corner, const std::array<Vec3d, 3>& ways, double distance) {
  return curved(
      {corner + ways[0] * distance, corner + ways[1] * distance, corner + ways[2] * distance},
      {corner, corner, corner});
}

std::array<OffsetCell, 2> halves_of(const OffsetCell& cell) {
  if (cell.about.size() == 4) return halves_round_edge(cell);
  if (cell.about.size() == 3) return halves_round_corner(cell);
  const auto& p = cell.corners;
  Vec3d longest;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j)
      if (dot(p[j] - p[i], p[j] - p[i]) > dot(longest, longest)) longest = p[j] - p[i];
  ProjectionInterval r;
  for (const Vec3d& q : p) r.include(dot(longest, q));
  const double middle = (r.lo + r.hi) / 2;
  return {clip_to(cell, {longest, middle}), clip_to(cell, {-longest, -middle})};
}

OffsetCell clip_to(const OffsetCell& cell, const HalfSpace& space) {
  OffsetCell part{.corners = {}, .about = {}, .slack = cell.slack, .on_surface = cell.on_surface};
  const auto& p = cell.corners;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3d& q = p[(i + 1) % p.size()];
    const double at_p = dot(space.normal, p[i]) - space.offset;
    const double at_q = dot(space.normal, q) - space.offset;
    if (at_p <= 0) part.corners.push_back(p[i]);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
      part.corners.push_back(p[i] + (q - p[i]) * (at_p / (at_p - at_q)));
  }
  return part;
}

bool is_cell_apart(std::span<const Vec3d> cell, const Corners& triangle, double by) {
  const auto apart_along = [&](const Vec3d& way) {
    const double squared = dot(way, way);
    if (!(squared > 0)) return false;
    ProjectionInterval r;
    for (const Vec3d& p : triangle) r.include(dot(way, p));
    const bool above = dot(way, cell.front()) > r.hi;
    double gap = std::numeric_limits<double>::infinity();
    for (const Vec3d& p : cell) {
      const double at = dot(way, p);
      gap = std::min(gap, above ? at - r.hi : r.lo - at);
      if (!(gap > 0)) return false;
    }
    return gap * gap > by * by * squared;
  };
  const std::size_t n = cell.size();
  const Vec3d normal = normal_of(triangle);
  const Vec3d up = n > 2 ? cross(cell[1] - cell[0], cell[2] - cell[0]) : normal;
  if (apart_along(normal) || apart_along(up)) return true;
  const std::array<Vec3d, 3> sides{triangle[1] - triangle[0], triangle[2] - triangle[1],
                                   triangle[0] - triangle[2]};
  for (const Vec3d& side : sides)
    if (apart_along(cross(normal, side))) return true;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d edge = cell[(i + 1) % n] - cell[i];
    if (apart_along(cross(up, edge))) return true;
    for (const Vec3d& side : sides)
      if (apart_along(cross(edge, side))) return true;
  }
  return false;
}

CellHull::CellHull(const OffsetCell& cell, double slack)
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
  ProjectionInterval r;
  for (const Vec3d& p : cell_.corners) r.include(dot(triangle.unit, p));
  return r.lo - triangle.hi > slack_ || triangle.lo - r.hi > slack_;
}

bool CellHull::goes_through(const PreparedTriangle& triangle) const {
  const Vec3d line = cross(triangle.unit, up_);
  const auto chord = [&](std::span<const Vec3d> corners, const Vec3d& normal, double offset) {
    ProjectionInterval r;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3d &p = corners[i], &q = corners[i + 1 == corners.size() ? 0 : i + 1];
      const double at_p = dot(normal, p) - offset, at_q = dot(normal, q) - offset;
      if ((at_p < 0) != (at_q < 0)) r.include(dot(line, p + (q - p) * (at_p / (at_p - at_q))));
    }
    return r;
  };
  const ProjectionInterval own = chord(cell_.corners, triangle.unit, triangle.lo);
  const ProjectionInterval other = chord(triangle.corners, up_, along_up_.lo);
  return own.lo < other.hi && other.lo < own.hi;
}

bool is_outside(const DistanceField& field, const CellHull& cell, const Vec3d& middle,
                QueryContext& work) {
  return field.for_each_near(cell.corners(), cell.slack(), [&](std::uint32_t t) {
    const PreparedTriangle triangle = field.placed_triangle(t);
    return cell.is_clearly_apart(triangle) || cell.is_apart(triangle);
  }) && !field.contains(middle, work);
}

CellCuller::CellStatus CellCuller::classify(const CellHull& cell, const CellStatus& from,
                                            const Vec3d& middle, std::vector<Corners>& crossing,
                                            QueryContext& work) {
  if (from.known && from.side != CellSide::both) return from;
  CellStatus before = from;
  if (!from.known) before.last = read(cell);
  list_.resize(before.last);
  CellStatus about{.first = before.last, .known = true};
  const std::size_t others = crossing.size();
  for (std::uint32_t i = before.first; i < before.last; ++i) {
    const PreparedTriangle& triangle = triangles_[list_[i]];
    const bool many = crossing.size() - others > kMaxCrossing;
    if (cell.is_clearly_apart(triangle) || (!many && cell.is_apart(triangle))) continue;
    if (!many) crossing.push_back(triangle.corners);
    list_.push_back(list_[i]);
  }
  about.last = static_cast<std::uint32_t>(list_.size());
  if (about.first == about.last)
    about.side = field_.contains(middle, work) ? CellSide::inside : CellSide::outside;
  return about;
}

std::uint32_t CellCuller::read(const CellHull& cell) {
  triangles_.clear();
  list_.clear();
  field_.for_each_near(cell.corners(), cell.slack(), [&](std::uint32_t t) {
    list_.push_back(static_cast<std::uint32_t>(triangles_.size()));
    triangles_.push_back(field_.placed_triangle(t));
    return true;
  });
  return static_cast<std::uint32_t>(list_.size());
}

}  // namespace strake::geometry
