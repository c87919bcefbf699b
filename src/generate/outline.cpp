// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "generate/mesh_kit.hpp"

namespace strake::generate {
namespace {

using geometry::Triangle;
using geometry::Vec3d;

/// A polygon as a ring of indices into a table of points; holes are joined to it by bridges.
struct Loop {
  std::vector<Flat> points;
  std::vector<std::uint32_t> order;
};

std::int64_t turn_of(const Flat& a, const Flat& b, const Flat& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

bool in_closed_triangle(const Flat& p, const Flat& a, const Flat& b, const Flat& c) {
  return turn_of(a, b, p) >= 0 && turn_of(b, c, p) >= 0 && turn_of(c, a, p) >= 0;
}

bool is_ear(const Loop& loop, std::size_t i) {
  const std::size_t n = loop.order.size();
  const Flat& a = loop.points[loop.order[(i + n - 1) % n]];
  const Flat& b = loop.points[loop.order[i]];
  const Flat& c = loop.points[loop.order[(i + 1) % n]];
  if (turn_of(a, b, c) <= 0) return false;
  return std::none_of(loop.order.begin(), loop.order.end(), [&](std::uint32_t index) {
    const Flat& p = loop.points[index];
    return !(p == a) && !(p == b) && !(p == c) && in_closed_triangle(p, a, b, c);
  });
}

bool properly_cross(const Flat& a, const Flat& b, const Flat& c, const Flat& d) {
  const auto sign = [](std::int64_t v) { return (v > 0) - (v < 0); };
  return sign(turn_of(a, b, c)) * sign(turn_of(a, b, d)) <= 0 &&
         sign(turn_of(c, d, a)) * sign(turn_of(c, d, b)) <= 0;
}

/// True when the segment between two points meets no edge that does not end in one of them.
bool sees(const Loop& loop, std::span<const std::vector<std::uint32_t>> others, const Flat& from,
          const Flat& to) {
  const auto blocked = [&](const std::vector<std::uint32_t>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Flat& c = loop.points[ring[i]];
      const Flat& d = loop.points[ring[(i + 1) % ring.size()]];
      if (c == from || c == to || d == from || d == to) continue;
      if (properly_cross(from, to, c, d)) return true;
    }
    return false;
  };
  if (blocked(loop.order)) return false;
  return std::none_of(others.begin(), others.end(), blocked);
}

/// Joins the hole to the loop by the shortest bridge that crosses nothing.
void bridge(Loop& loop, std::span<const std::vector<std::uint32_t>> holes) {
  const std::vector<std::uint32_t>& hole = holes.front();
  std::int64_t best = -1;
  std::size_t best_outer = 0, best_hole = 0;
  for (std::size_t i = 0; i < loop.order.size(); ++i)
    for (std::size_t j = 0; j < hole.size(); ++j) {
      const Flat& a = loop.points[loop.order[i]];
      const Flat& b = loop.points[hole[j]];
      const std::int64_t d = (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v);
      if ((best >= 0 && d >= best) || !sees(loop, holes, a, b)) continue;
      best = d, best_outer = i, best_hole = j;
    }
  std::vector<std::uint32_t> piece;
  for (std::size_t j = 0; j <= hole.size(); ++j)  // clockwise, as the inner side of a boundary runs
    piece.push_back(hole[(best_hole + hole.size() - j % hole.size()) % hole.size()]);
  piece.push_back(loop.order[best_outer]);
  loop.order.insert(loop.order.begin() + static_cast<std::ptrdiff_t>(best_outer) + 1, piece.begin(),
                    piece.end());
}

double tan_of_half_step(int sides) {                     // tan(180°/sides)
  double t = sides % 3 == 0 ? 1 / std::sqrt(3.0) : 1.0;  // 30° or 45°
  for (int n = sides % 3 == 0 ? 6 : 4; n < sides; n *= 2) t = (std::sqrt(1 + t * t) - 1) / t;
  return t;
}

}  // namespace

std::int64_t um(double mm) { return std::llround(mm * 1000); }

Outline outline(std::span<const Vec3d> uv_mm) {
  Outline result;
  for (const Vec3d& p : uv_mm) result.push_back({um(p.x), um(p.y)});
  return result;
}

Outline ring(int sides, std::int64_t r) {
  const double t = tan_of_half_step(sides);
  const double c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
  const int quarter = sides / 4;
  Outline first;
  double u = 1, v = t;
  for (int k = 0; k < quarter; ++k) {
    first.push_back(
        {std::llround(u * static_cast<double>(r)), std::llround(v * static_cast<double>(r))});
    const double w = u * c - v * s;
    v = u * s + v * c;
    u = w;
  }
  first.back() = {first.front().v, first.front().u};  // the flat across v stands at exactly r too
  Outline result;
  for (int q = 0; q < 4; ++q)
    for (const Flat& p : first)
      result.push_back(q == 0   ? p
                       : q == 1 ? Flat{-p.v, p.u}
                       : q == 2 ? Flat{-p.u, -p.v}
                                : Flat{p.v, -p.u});
  return result;
}

Vec3d unit_15deg(int step) {
  const int turned = ((step % 24) + 24) % 24;
  const int rest = turned % 6;
  const double cos_of[6] = {
      1,   (std::sqrt(6.0) + std::sqrt(2.0)) / 4, std::sqrt(3.0) / 2, std::sqrt(2.0) / 2,
      0.5, (std::sqrt(6.0) - std::sqrt(2.0)) / 4};
  const double c = cos_of[rest], s = rest == 0 ? 0 : cos_of[6 - rest];
  switch (turned / 6) {
    case 0:
      return {c, s, 0};
    case 1:
      return {-s, c, 0};
    case 2:
      return {-c, -s, 0};
    default:
      return {s, -c, 0};
  }
}

std::vector<Triangle> triangulate_outline(const Outline& outer, std::span<const Outline> holes) {
  Loop loop;
  loop.points = outer;
  for (std::uint32_t i = 0; i < outer.size(); ++i) loop.order.push_back(i);
  std::vector<std::vector<std::uint32_t>> rings;
  for (const Outline& hole : holes) {
    std::vector<std::uint32_t>& indices = rings.emplace_back();
    for (const Flat& p : hole) {
      indices.push_back(static_cast<std::uint32_t>(loop.points.size()));
      loop.points.push_back(p);
    }
  }
  for (std::size_t h = 0; h < rings.size(); ++h) bridge(loop, std::span(rings).subspan(h));
  std::vector<Triangle> triangles;
  while (loop.order.size() > 3) {
    const std::size_t n = loop.order.size();
    std::size_t ear = 0;
    while (ear < n && !is_ear(loop, ear)) ++ear;
    if (ear == n) break;  // not a simple polygon: the edge check of the tests shows it
    triangles.push_back(
        {loop.order[(ear + n - 1) % n], loop.order[ear], loop.order[(ear + 1) % n]});
    loop.order.erase(loop.order.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({loop.order[0], loop.order[1], loop.order[2]});
  return triangles;
}

}  // namespace strake::generate
