// SPDX-License-Identifier: Apache-2.0
#include "geometry/parting/ways_back.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/corners.hpp"
#include "geometry/directions.hpp"
#include "geometry/piece_segment.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

bool is_near(const DoubleSegment& s, const Vec3d& corner, double distance) {
  return std::ranges::all_of(s, [&](const Vec3d& p) { return length(p - corner) <= distance; });
}

/// To the line through two points.
bool is_near(const DoubleSegment& s, const Vec3d& from, const Vec3d& to, double distance) {
  const Vec3d along = to - from;
  const double most = distance * length(along);
  return std::ranges::all_of(
      s, [&](const Vec3d& p) { return length(cross(along, p - from)) <= most; });
}

}  // namespace

std::vector<CornerWay> ways_back(const PartView& a, const PartView& b, const CrossingPiece& piece,
                                 bool of_b, std::uint32_t triangle, double reach) {
  const auto segment = segment_of(a, b, piece);
  if (!segment) return {};
  const PartView &own = of_b ? b : a, &other = of_b ? a : b;
  const TriangleCorners across = other.corners(of_b ? piece.a : piece.b);
  // Exact before it is rounded: the same from whichever corner.
  Vec3d n = cross_exact(across[1] - across[0], across[2] - across[0]).as<double>();
  n = n * (1 / length(n));
  const TriangleCorners exact = own.corners(triangle);
  const Corners t = as_doubles(exact);
  const Vec3d m = normal_of(t);
  const double sine = length(cross(n, m)) / length(m);
  if (!(sine > 0)) return {};
  const double distance = reach / sine;
  const auto height = [&](std::size_t i) { return dot(n, (exact[i] - across[0]).as<double>()); };
  const auto way = [&](std::size_t i, double side) {
    return CornerWay{own.part().triangles[triangle][i], n * (side < 0 ? -1.0 : 1.0)};
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const double next = height((i + 1) % 3), last = height((i + 2) % 3);
    if (is_near(*segment, t[i], distance))
      return {way(i, std::fabs(next) > std::fabs(last) ? next : last)};
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = height((i + 2) % 3);
    if (side != 0 && is_near(*segment, t[i], t[(i + 1) % 3], distance))
      return {way(i, side), way((i + 1) % 3, side)};
  }
  return {};
}

}  // namespace strake::geometry
