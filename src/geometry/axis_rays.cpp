// SPDX-License-Identifier: Apache-2.0
#include "geometry/axis_rays.hpp"

#include <array>
#include <utility>

#include "geometry/corner_index.hpp"
#include "strake/geometry/part_edges.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

std::span<const std::uint32_t> star_between(const Part& part, std::uint32_t u, std::uint32_t v) {
  const std::uint32_t edge = edge_between(part, u, v);
  return edge == kNoFace ? std::span<const std::uint32_t>{} : triangles_round(part, edge);
}

/// Whether two parallel directions point the same way.
bool same_way(const Vec3l& d, const Vec3l& e) {
  for (int k = 0; k < 3; ++k)
    if (d[k] != 0) return (d[k] > 0) == (e[k] > 0);
  return true;
}

}  // namespace

std::span<const std::uint32_t> star(const Part& part, std::uint32_t triangle, int edge) {
  const Triangle& t = part.triangles[triangle];
  return star_between(part, t[at(edge)], t[at(next_corner(edge))]);
}

void start_axis(Sectors& sectors, const PartView& view, std::uint32_t triangle, int edge) {
  const Triangle& t = view.part().triangles[triangle];
  sectors.start(view.vertex(t[at(edge)]), view.vertex(t[at(next_corner(edge))]));
}

void add_star(Sectors& sectors, const PartView& view, std::uint32_t triangle, int edge, bool of_b) {
  const Part& part = view.part();
  const Triangle& t = part.triangles[triangle];
  std::uint32_t u = t[at(edge)], v = t[at(next_corner(edge))];
  if (!same_way(sectors.to() - sectors.from(), view.vertex(v) - view.vertex(u))) std::swap(u, v);
  for (const std::uint32_t other : star_between(part, u, v)) {
    const Triangle& o = part.triangles[other];
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t p = o[at(i)], q = o[at(next_corner(i))];
      if (!((p == u && q == v) || (p == v && q == u))) continue;
      // A triangle that runs along the axis has its outside counter-clockwise of it.
      sectors.add({view.vertex(o[at(next_corner(next_corner(i)))]), p == u ? -1 : 1, of_b, other});
    }
  }
}

void add_coordinate_face(Sectors& sectors, const PartView& view, std::uint32_t triangle,
                         bool of_b) {
  const std::array<Vec3l, 3> t = view.corners(triangle);
  int axis = 0;
  while (t[0][axis] != t[1][axis] || t[0][axis] != t[2][axis]) ++axis;
  const int facing = orient2d(t[0], t[1], t[2], axis);
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  Vec3l step;
  step[sectors.from()[y] != sectors.to()[y] ? x : y] = 1;
  for (const Vec3l& beside : {sectors.from() + step, sectors.from() - step}) {
    const int turn = orient2d(sectors.from(), sectors.to(), beside, axis);
    sectors.add({beside, turn == facing ? -1 : 1, of_b, triangle});
  }
}

void add_face(Sectors& sectors, const PartView& view, std::uint32_t triangle, bool of_b) {
  const std::array<Vec3l, 3> t = view.corners(triangle);
  for (int axis = 0; axis < 3; ++axis) {
    const int facing = orient2d(t[0], t[1], t[2], axis);
    if (facing == 0) continue;
    bool left = false, right = false;
    for (const Vec3l& corner : t) {
      const int turn = orient2d(sectors.from(), sectors.to(), corner, axis);
      bool& done = turn > 0 ? left : right;
      if (turn == 0 || done) continue;
      done = true;
      sectors.add({corner, turn == facing ? -1 : 1, of_b, triangle});
    }
    return;
  }
}

}  // namespace strake::geometry
