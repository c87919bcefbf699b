// SPDX-License-Identifier: Apache-2.0
#include "geometry/piece_segment.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "geometry/corner_index.hpp"
#include "geometry/corners.hpp"
#include "geometry/directions.hpp"

namespace strake::geometry {
namespace {

/// Where segment p-q pierces a triangle or ends on it.
std::optional<Vec3d> pierce(const Vec3d& p, const Vec3d& q, const Corners& t) {
  const Vec3d n = normal_of(t);
  const double sp = dot(n, p - t[0]), sq = dot(n, q - t[0]);
  if ((sp > 0) == (sq > 0) || sp == sq) return std::nullopt;
  const Vec3d x = p + (q - p) * (sp / (sp - sq));
  const double slack = -1e-9 * dot(n, n);
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(cross(t[(i + 1) % 3] - t[i], x - t[i]), n) < slack) return std::nullopt;
  return x;
}

/// What two triangles that cross have in common.
std::optional<DoubleSegment> common_segment(const Corners& x, const Corners& y) {
  std::array<Vec3d, 6> points;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (const auto p = pierce(x[i], x[(i + 1) % 3], y)) points[count++] = *p;
    if (const auto p = pierce(y[i], y[(i + 1) % 3], x)) points[count++] = *p;
  }
  if (count == 0) return std::nullopt;
  DoubleSegment best{points[0], points[0]};
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      if (length(points[j] - points[i]) > length(best[1] - best[0])) best = {points[i], points[j]};
  return best;
}

/// The part of a segment from `low` to `high` of its length.
std::optional<DoubleSegment> part_of(const DoubleSegment& s, double low, double high) {
  if (!(low < high)) return std::nullopt;
  const Vec3d along = s[1] - s[0];
  return DoubleSegment{s[0] + along * low, s[0] + along * high};
}

/// What a segment in a triangle's plane has in common with it.
std::optional<DoubleSegment> clipped(const DoubleSegment& s, const Corners& t) {
  const Vec3d n = normal_of(t);
  double low = 0, high = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d inward = cross(n, t[(i + 1) % 3] - t[i]);
    const double from = dot(inward, s[0] - t[i]), to = dot(inward, s[1] - t[i]);
    if (from < 0 && to <= 0) return std::nullopt;
    if (from < 0) low = std::max(low, from / (from - to));
    if (to < 0) high = std::min(high, from / (from - to));
  }
  return part_of(s, low, high);
}

/// What two segments of one line have in common.
std::optional<DoubleSegment> common_stretch(const DoubleSegment& s, const DoubleSegment& t) {
  const Vec3d along = s[1] - s[0];
  const double scale = 1 / dot(along, along);
  const double from = dot(along, t[0] - s[0]) * scale, to = dot(along, t[1] - s[0]) * scale;
  return part_of(s, std::max(0.0, std::min(from, to)), std::min(1.0, std::max(from, to)));
}

Corners corners(const PartView& view, std::uint32_t triangle) {
  return as_doubles(view.corners(triangle));
}

DoubleSegment edge_of(const PartView& view, std::uint32_t triangle, int edge) {
  const Corners t = corners(view, triangle);
  return {t[at(edge)], t[at(next_corner(edge))]};
}

}  // namespace

std::optional<DoubleSegment> segment_of(const PartView& a, const PartView& b,
                                        const CrossingPiece& p) {
  if (p.edge_a < 0 && p.edge_b < 0) return common_segment(corners(a, p.a), corners(b, p.b));
  if (p.edge_b < 0) return clipped(edge_of(a, p.a, p.edge_a), corners(b, p.b));
  if (p.edge_a < 0) return clipped(edge_of(b, p.b, p.edge_b), corners(a, p.a));
  return common_stretch(edge_of(a, p.a, p.edge_a), edge_of(b, p.b, p.edge_b));
}

}  // namespace strake::geometry
