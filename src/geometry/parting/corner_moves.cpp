// SPDX-License-Identifier: Apache-2.0
#include "geometry/parting/corner_moves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/directions.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

/// What a triangle says of a corner, or is said of it besides.
struct Say {
  std::uint32_t vertex = 0;
  bool leads = false;
  bool besides = false;
  Vec3d way;  ///< unit
};

/// Moves in all directions, each as long as allowed or a little shorter.
std::vector<Vec3i> moves_up_to(double most) {
  // Of the contact distance of sound numbers, 3, these are all the moves there are.
  const int r = std::clamp(static_cast<int>(most), 1, 4);
  const double step = most / r;
  std::vector<Vec3i> moves;
  for (int x = -r; x <= r; ++x)
    for (int y = -r; y <= r; ++y)
      for (int z = -r; z <= r; ++z)
        if (x * x + y * y + z * z <= r * r)
          moves.push_back((Vec3d{1.0 * x, 1.0 * y, 1.0 * z} * step).as<std::int32_t>());
  return moves;
}

Vec3i best_move(std::span<const Say> say, const std::vector<Vec3i>& moves) {
  const bool led = std::ranges::any_of(say, &Say::leads);
  Vec3i best;
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3i& move : moves) {
    const Vec3d way = move.as<double>();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < say.size() && least > most; ++i)
      if (say[i].leads || say[i].besides || !led) least = std::min(least, dot(say[i].way, way));
    if (least > most) {
      most = least;
      best = move;
    }
  }
  return best;
}

}  // namespace

std::vector<CornerMove> corner_moves(const Part& part, std::span<const MovingTriangle> triangles,
                                     std::span<const CornerWay> ways, double most) {
  std::vector<Say> say;
  say.reserve(3 * triangles.size() + ways.size());
  for (const MovingTriangle& t : triangles) {
    const Triangle& corner = part.triangles[t.triangle];
    const auto at = [&](std::size_t i) { return part.vertices[corner[i]].as<std::int64_t>(); };
    // Exact before it is rounded: the same from whichever corner.
    Vec3d n = cross_exact(at(1) - at(0), at(2) - at(0)).as<double>();
    n = n * ((t.outward ? 1 : -1) / length(n));
    for (const std::uint32_t v : corner) say.push_back({v, t.leads, false, n});
  }
  for (const CornerWay& w : ways) say.push_back({w.vertex, false, true, w.way});
  std::ranges::sort(say, {}, &Say::vertex);
  const std::vector<Vec3i> moves = moves_up_to(most);
  std::vector<CornerMove> all;
  for (std::size_t i = 0; i < say.size();) {
    std::size_t end = i + 1;
    while (end < say.size() && say[end].vertex == say[i].vertex) ++end;
    all.push_back({say[i].vertex, best_move(std::span(say).subspan(i, end - i), moves)});
    i = end;
  }
  return all;
}

}  // namespace strake::geometry
