// SPDX-License-Identifier: Apache-2.0
#include "geometry/analyse/nest.hpp"

#include <algorithm>
#include <numeric>

namespace strake::geometry {
namespace {

using Wide = __int128;

/// Points are compared at six times the grid, so that midpoints and centroids are integers too.
constexpr std::int64_t kFine = 6;

Vec3l fine(const Vec3i& v) { return v.as<std::int64_t>() * kFine; }

int sign(Wide value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

Wide area_2(const Vec3l& a, const Vec3l& b, const Vec3l& c, int u, int v) {
  return Wide{b[u] - a[u]} * (c[v] - a[v]) - Wide{b[v] - a[v]} * (c[u] - a[u]);
}

/// Sign of (b - a) x (c - a) · (p - a).
int side_of_plane(const Vec3l& a, const Vec3l& b, const Vec3l& c, const Vec3l& p) {
  const Vec3l u = b - a, v = c - a, w = p - a;
  return sign(w.x * (Wide{u.y} * v.z - Wide{u.z} * v.y) +
              w.y * (Wide{u.z} * v.x - Wide{u.x} * v.z) +
              w.z * (Wide{u.x} * v.y - Wide{u.y} * v.x));
}

/// Whether a point of the plane of a triangle lies in the closed triangle.
bool in_triangle(const Vec3l& a, const Vec3l& b, const Vec3l& c, const Vec3l& p) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int whole = sign(area_2(a, b, c, u, v));
    if (whole == 0) continue;
    return sign(area_2(a, b, p, u, v)) * whole >= 0 && sign(area_2(b, c, p, u, v)) * whole >= 0 &&
           sign(area_2(c, a, p, u, v)) * whole >= 0;
  }
  return false;
}

/// Side of p, moved by (0, e, e²) for an infinitesimal e, of the line a-b seen along x; zero only
/// when the line itself runs along x.
int shifted_side(const Vec3l& a, const Vec3l& b, const Vec3l& p) {
  if (const int s = sign(area_2(a, b, p, 1, 2)); s != 0) return s;
  if (a.z != b.z) return a.z > b.z ? 1 : -1;
  return b.y > a.y ? 1 : b.y < a.y ? -1 : 0;
}

enum class Side : std::uint8_t { outside, on, inside };

/// Exact side of a fine point of a closed shell: signed crossings of the ray along +x.
Side side_of_shell(const Part& shell, const Vec3l& p) {
  int winding = 0;
  for (const Triangle& t : shell.triangles) {
    const Vec3l a = fine(shell.vertices[t[0]]), b = fine(shell.vertices[t[1]]),
                c = fine(shell.vertices[t[2]]);
    if (std::max({a.x, b.x, c.x}) < p.x) continue;
    if (std::max({a.y, b.y, c.y}) < p.y || std::min({a.y, b.y, c.y}) > p.y) continue;
    if (std::max({a.z, b.z, c.z}) < p.z || std::min({a.z, b.z, c.z}) > p.z) continue;
    const int above = side_of_plane(a, b, c, p);
    if (above == 0 && in_triangle(a, b, c, p)) return Side::on;
    const int ab = shifted_side(a, b, p);
    if (ab == 0 || shifted_side(b, c, p) != ab || shifted_side(c, a, p) != ab) continue;
    // The normal's x component has the sign ab: the plane lies ahead of p when they differ.
    if (above * ab < 0) winding += ab;
  }
  return winding != 0 ? Side::inside : Side::outside;
}

/// True when no vertex of `inner` lies outside `outer` and one point of it lies strictly inside.
bool within(const Part& inner, const Part& outer) {
  bool strictly = false;
  for (const Vec3i& v : inner.vertices) {
    const Side side = side_of_shell(outer, fine(v));
    if (side == Side::outside) return false;
    strictly = strictly || side == Side::inside;
  }
  for (const Triangle& t : inner.triangles) {
    const Vec3l sum = inner.vertices[t[0]].as<std::int64_t>() +
                      inner.vertices[t[1]].as<std::int64_t>() +
                      inner.vertices[t[2]].as<std::int64_t>();
    const Side side = side_of_shell(outer, sum * (kFine / 3));
    if (side == Side::outside) return false;
    strictly = strictly || side == Side::inside;
  }
  return strictly;
}

bool box_within(const Box3i& inner, const Box3i& outer) {
  for (int k = 0; k < 3; ++k)
    if (inner.lo[k] < outer.lo[k] || inner.hi[k] > outer.hi[k]) return false;
  return true;
}

}  // namespace

std::vector<std::uint32_t> find_parents(std::span<const Part> shells) {
  // By volume: the first container met is the smallest.
  std::vector<std::uint32_t> order(shells.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return shells[a].volume < shells[b].volume;
  });
  std::vector<std::uint32_t> parents(shells.size(), kNoShell);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const Part& inner = shells[order[i]];
      const Part& outer = shells[order[k]];
      if (!box_within(inner.box, outer.box) || !within(inner, outer)) continue;
      parents[order[i]] = order[k];
      break;
    }
  return parents;
}

}  // namespace strake::geometry
