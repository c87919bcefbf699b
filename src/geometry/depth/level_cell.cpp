// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/level_cell.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "geometry/directions.hpp"
#include "geometry/range.hpp"

namespace strake::geometry {
namespace {

/// How far a sphere or cylinder about the points stands out of the hull of a cell's corners.
double bulge(const LevelCell& cell) {
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

LevelCell curved(std::vector<Vec3d> corners, std::vector<Vec3d> about) {
  LevelCell cell{.corners = std::move(corners), .about = std::move(about)};
  cell.slack = bulge(cell);
  return cell;
}

/// Half way between two corners, on the curved surface.
Vec3d between(const LevelCell& cell, std::size_t i, std::size_t j, const Vec3d& about) {
  const Vec3d p = cell.corners[i] - cell.about[i], q = cell.corners[j] - cell.about[j];
  return about + unit(p + q) * length(p);
}

/// The corners of a cell that goes round an edge: 0 and 1 at one end, 3 and 2 at the other.
std::array<LevelCell, 2> halves_round_edge(const LevelCell& cell) {
  const auto& [p, about, slack, on_skin] = cell;
  const Vec3d near = between(cell, 0, 1, about[0]), far = between(cell, 3, 2, about[3]);
  return {curved({p[0], near, far, p[3]}, about), curved({near, p[1], p[2], far}, about)};
}

std::array<LevelCell, 2> halves_round_corner(const LevelCell& cell) {
  const auto& p = cell.corners;
  std::size_t longest = 0;
  double most = -1;
  for (std::size_t i = 0; i < 3; ++i)
    if (const double size = length(p[(i + 1) % 3] - p[i]); size > most) {
      most = size;
      longest = i;
    }
  const std::size_t i = longest, j = (i + 1) % 3, k = (i + 2) % 3;
  const Vec3d middle = between(cell, i, j, cell.about[0]);
  return {curved({p[i], middle, p[k]}, cell.about), curved({middle, p[j], p[k]}, cell.about)};
}

}  // namespace

Vec3d middle_of(const LevelCell& cell) {
  Vec3d sum;
  for (const Vec3d& p : cell.corners) sum = sum + p;
  return sum * (1 / static_cast<double>(cell.corners.size()));
}

double radius_of(const LevelCell& cell, const Vec3d& from) {
  double most = 0;
  for (const Vec3d& p : cell.corners) most = std::max(most, dot(p - from, p - from));
  return std::sqrt(most);
}

LevelCell flat_cell(const Corners& triangle, const Vec3d& way) {
  return {.corners = {triangle[0] + way, triangle[1] + way, triangle[2] + way}, .about = {}};
}

LevelCell round_edge(const std::array<Vec3d, 2>& edge, const std::array<Vec3d, 2>& ways,
                     double distance) {
  const auto& [p, q] = edge;
  const Vec3d first = ways[0] * distance, last = ways[1] * distance;
  return curved({p + first, p + last, q + last, q + first}, {p, p, q, q});
}

LevelCell round_corner(const Vec3d& corner, const std::array<Vec3d, 3>& ways, double distance) {
  return curved(
      {corner + ways[0] * distance, corner + ways[1] * distance, corner + ways[2] * distance},
      {corner, corner, corner});
}

std::array<LevelCell, 2> halves_of(const LevelCell& cell) {
  if (cell.about.size() == 4) return halves_round_edge(cell);
  if (cell.about.size() == 3) return halves_round_corner(cell);
  const auto& p = cell.corners;
  Vec3d longest;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size(); ++j)
      if (dot(p[j] - p[i], p[j] - p[i]) > dot(longest, longest)) longest = p[j] - p[i];
  Range r;
  for (const Vec3d& q : p) r.include(dot(longest, q));
  const double middle = (r.lo + r.hi) / 2;
  return {part_in(cell, {longest, middle}), part_in(cell, {-longest, -middle})};
}

LevelCell part_in(const LevelCell& cell, const HalfSpace& space) {
  LevelCell part{.corners = {}, .about = {}, .slack = cell.slack, .on_skin = cell.on_skin};
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

bool are_apart(std::span<const Vec3d> cell, const Corners& triangle, double by) {
  const auto apart_along = [&](const Vec3d& way) {
    const double squared = dot(way, way);
    if (!(squared > 0)) return false;
    Range r;
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

}  // namespace strake::geometry
