// SPDX-License-Identifier: Apache-2.0
#include "geometry/sheet_separation/vertex_displacements.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/intersect/intersection_segments.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

/// A constraint on the displacement of a vertex, by a triangle or a further direction.
struct DisplacementConstraint {
  std::uint32_t vertex = 0;
  bool leads = false;
  bool besides = false;
  Vec3d way;  ///< unit
};

/// Returns displacements in all directions, each as long as allowed or slightly shorter.
std::vector<Vec3i> moves_up_to(double limit) {
  // Of the contact distance of sound numbers, 3, these are all the moves there are.
  const int r = std::clamp(static_cast<int>(limit), 1, 4);
  const double step = limit / r;
  std::vector<Vec3i> moves;
  for (int x = -r; x <= r; ++x)
    for (int y = -r; y <= r; ++y)
      for (int z = -r; z <= r; ++z)
        if (x * x + y * y + z * z <= r * r)
          moves.push_back((Vec3d{1.0 * x, 1.0 * y, 1.0 * z} * step).as<std::int32_t>());
  return moves;
}

Vec3i best_move(std::span<const DisplacementConstraint> constraints,
                const std::vector<Vec3i>& moves) {
  const bool led = std::ranges::any_of(constraints, &DisplacementConstraint::leads);
  Vec3i best;
  double limit = -std::numeric_limits<double>::infinity();
  for (const Vec3i& move : moves) {
    const Vec3d way = move.as<double>();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < constraints.size() && least > limit; ++i)
      if (constraints[i].leads || constraints[i].besides || !led)
        least = std::min(least, dot(constraints[i].way, way));
    if (least > limit) {
      limit = least;
      best = move;
    }
  }
  return best;
}

}  // namespace

std::vector<VertexDisplacement> vertex_displacements(const Part& part,
                                                     std::span<const MovingTriangle> triangles,
                                                     std::span<const VertexDirection> ways,
                                                     double limit) {
  std::vector<DisplacementConstraint> constraints;
  constraints.reserve(3 * triangles.size() + ways.size());
  for (const MovingTriangle& t : triangles) {
    const Triangle& corner = part.triangles[t.triangle];
    const auto at = [&](std::size_t i) { return part.vertices[corner[i]].as<std::int64_t>(); };
    // Exact before it is rounded: the same from whichever corner.
    Vec3d n = cross_exact(at(1) - at(0), at(2) - at(0)).as<double>();
    n = n * ((t.outward ? 1 : -1) / length(n));
    for (const std::uint32_t v : corner) constraints.push_back({v, t.leads, false, n});
  }
  for (const VertexDirection& w : ways) constraints.push_back({w.vertex, false, true, w.way});
  std::ranges::sort(constraints, {}, &DisplacementConstraint::vertex);
  const std::vector<Vec3i> moves = moves_up_to(limit);
  std::vector<VertexDisplacement> all;
  for (std::size_t i = 0; i < constraints.size();) {
    std::size_t end = i + 1;
    while (end < constraints.size() && constraints[end].vertex == constraints[i].vertex) ++end;
    all.push_back(
        {constraints[i].vertex, best_move(std::span(constraints).subspan(i, end - i), moves)});
    i = end;
  }
  return all;
}

namespace {

bool is_near(const DoubleSegment& s, const Vec3d& corner, double distance) {
  return std::ranges::all_of(s, [&](const Vec3d& p) { return length(p - corner) <= distance; });
}

/// Whether a segment is near the line through two points.
bool is_near(const DoubleSegment& s, const Vec3d& from, const Vec3d& to, double distance) {
  const Vec3d along = to - from;
  const double limit = distance * length(along);
  return std::ranges::all_of(
      s, [&](const Vec3d& p) { return length(cross(along, p - from)) <= limit; });
}

}  // namespace

std::vector<VertexDirection> retraction_directions(const PairLocalPart& a, const PairLocalPart& b,
                                                   const IntersectionSegment& piece, bool of_b,
                                                   std::uint32_t triangle, double reach) {
  const auto segment = segment_geometry(a, b, piece);
  if (!segment) return {};
  const PairLocalPart &own = of_b ? b : a, &other = of_b ? a : b;
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
    return VertexDirection{own.part().triangles[triangle][i], n * (side < 0 ? -1.0 : 1.0)};
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
