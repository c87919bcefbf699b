// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/triangle_contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/numeric/triangle_math.hpp"

namespace strake::geometry {
namespace {

/// An end of the segment in which a triangle meets a plane: where the directed edge from -> to,
/// which leads from the plane's closed negative to its closed positive side, meets the plane.
struct End {
  int from = 0, to = 0;
};

/// The segment in which a triangle meets a plane, from low to high along
/// (triangle's normal) x (plane's normal).
struct Section {
  End low, high;
  int edge = -1;       ///< the triangle's edge that lies in the plane, or -1
  bool point = false;  ///< low and high are one point
};

constexpr Section section_of(const CornerSides& side) {
  Section s;
  const int zeros = (side[0] == 0) + (side[1] == 0) + (side[2] == 0);
  for (int i = 0; i < 3; ++i) {
    const int j = next_corner(i), k = next_corner(j);
    const int si = side[at(i)], sj = side[at(j)], sk = side[at(k)];
    if (zeros == 2) {
      if (sk == 0) continue;
      s.edge = i;
      // Seen with the normal up the triangle lies left of its edge i.
      if (sk > 0)
        s.low = {j, k}, s.high = {i, k};
      else
        s.low = {k, i}, s.high = {k, j};
    } else if (zeros == 1) {
      if (si != 0) continue;
      const End corner = sj > 0 ? End{i, j} : End{j, i};
      s.low = s.high = corner;
      s.point = sj == sk;
      if (sj > 0 && sk < 0) s.high = {k, j};
      if (sj < 0 && sk > 0) s.low = {j, k};
    } else {
      if (si < 0 && sj > 0) s.low = {i, j};
      if (si > 0 && sj < 0) s.high = {j, i};
    }
  }
  return s;
}

constexpr std::array<Section, 27> make_sections() {
  std::array<Section, 27> table;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        table[at((x + 1) * 9 + (y + 1) * 3 + z + 1)] = section_of({x, y, z});
  return table;
}

constexpr std::array<Section, 27> kSections = make_sections();

const Section& section(const CornerSides& s) {
  return kSections[at((s[0] + 1) * 9 + (s[1] + 1) * 3 + s[2] + 1)];
}

bool all_positive(const CornerSides& s) { return s[0] > 0 && s[1] > 0 && s[2] > 0; }
bool all_negative(const CornerSides& s) { return s[0] < 0 && s[1] < 0 && s[2] < 0; }
bool all_zero(const CornerSides& s) { return s[0] == 0 && s[1] == 0 && s[2] == 0; }

/// Sign of (end of b) - (end of a) along (normal of a) x (normal of b).
int order(const ExactTriangle& a, const End& ea, const ExactTriangle& b, const End& eb) {
  return orient3d(a.corner[at(ea.from)], a.corner[at(ea.to)], b.corner[at(eb.from)],
                  b.corner[at(eb.to)]);
}

void cross_planes(const ExactTriangle& a, const ExactTriangle& b, TriangleContact& c) {
  const Section& sa = section(c.side_a);
  const Section& sb = section(c.side_b);
  // b's section is ordered along the opposite direction.
  const int first = order(a, sa.low, b, sb.low);
  if (first < 0) return;
  const int last = order(a, sa.high, b, sb.high);
  if (last > 0) return;
  if (sa.point || sb.point || first == 0 || last == 0) {
    c.touch = Touch::point;
    return;
  }
  c.touch = Touch::segment;
  c.edge_a = sa.edge;
  c.edge_b = sb.edge;
}

/// The largest component of the normal: never zero, so the projection along it is not degenerate.
int main_axis(const Vec3d& n) {
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/// Sides of the corners of one triangle against the edges of another in the common plane:
/// row i, column j = +1 when corner j lies on the inner side of edge i.
using EdgeSides = std::array<CornerSides, 3>;

EdgeSides edge_sides(const ExactTriangle& edges, const ExactTriangle& corners, int axis) {
  EdgeSides r;
  const int turn = orient2d(edges.corner[0], edges.corner[1], edges.corner[2], axis);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      r[at(i)][at(j)] = turn * orient2d(edges.corner[at(i)], edges.corner[at(next_corner(i))],
                                        corners.corner[at(j)], axis);
  return r;
}

bool none_inside(const CornerSides& s) { return s[0] <= 0 && s[1] <= 0 && s[2] <= 0; }

/// -1 apart, 0 a common point, 1 a common segment, for two segments on one line.
int collinear_overlap(const Vec3l& p, const Vec3l& q, const Vec3l& r, const Vec3l& s) {
  const Vec3l d = q - p;
  const int axis = d.x != 0 ? 0 : d.y != 0 ? 1 : 2;
  const std::int64_t low = std::max(std::min(p[axis], q[axis]), std::min(r[axis], s[axis]));
  const std::int64_t high = std::min(std::max(p[axis], q[axis]), std::max(r[axis], s[axis]));
  return low < high ? 1 : low == high ? 0 : -1;
}

/// Bit i: the open edge i of the triangle whose corners stand in `corner_sides` (against the other
/// triangle's edges) meets the other's open interior; `other_sides` is the converse table.
unsigned edges_inside(const EdgeSides& corner_sides, const EdgeSides& other_sides) {
  unsigned mask = 0;
  for (int i = 0; i < 3; ++i) {
    const CornerSides& line = other_sides[at(i)];
    const bool above = line[0] > 0 || line[1] > 0 || line[2] > 0;
    const bool below = line[0] < 0 || line[1] < 0 || line[2] < 0;
    if (!above || !below) continue;
    bool separated = false;
    for (const CornerSides& edge : corner_sides)
      separated |= edge[at(i)] <= 0 && edge[at(next_corner(i))] <= 0;
    if (!separated) mask |= 1U << i;
  }
  return mask;
}

/// Whether two coplanar closed triangles without common area share a point, given an edge line of
/// `a` that has none of b's corners on its inner side.
bool touch_on_line(const ExactTriangle& a, int edge, const ExactTriangle& b,
                   const CornerSides& line) {
  const Vec3l& p = a.corner[at(edge)];
  const Vec3l& q = a.corner[at(next_corner(edge))];
  const Vec3l *first = nullptr, *last = nullptr;
  for (int j = 0; j < 3; ++j) {
    if (line[at(j)] != 0) continue;
    if (first == nullptr) first = &b.corner[at(j)];
    last = &b.corner[at(j)];
  }
  return first != nullptr && collinear_overlap(p, q, *first, *last) >= 0;
}

void common_plane(const ExactTriangle& a, const ExactTriangle& b, TriangleContact& c) {
  c.coplanar = true;
  const int axis = main_axis(a.plane.normal());
  c.same_normal = (a.plane.normal()[axis] > 0) == (b.plane.normal()[axis] > 0);
  const EdgeSides b_to_a = edge_sides(a, b, axis);
  for (int i = 0; i < 3; ++i)
    if (none_inside(b_to_a[at(i)]) && !touch_on_line(a, i, b, b_to_a[at(i)])) return;
  const EdgeSides a_to_b = edge_sides(b, a, axis);
  bool separated = false;
  for (int i = 0; i < 3; ++i) {
    separated |= none_inside(b_to_a[at(i)]) || none_inside(a_to_b[at(i)]);
    if (none_inside(a_to_b[at(i)]) && !touch_on_line(b, i, a, a_to_b[at(i)])) return;
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (b_to_a[at(i)][at(j)] == 0 && b_to_a[at(i)][at(next_corner(j))] == 0 &&
          collinear_overlap(a.corner[at(i)], a.corner[at(next_corner(i))], b.corner[at(j)],
                            b.corner[at(next_corner(j))]) > 0)
        c.shared_edges |= 1U << (3 * i + j);
  if (separated) {
    c.touch = c.shared_edges != 0 ? Touch::segment : Touch::point;
    return;
  }
  c.touch = Touch::area;
  c.edges_of_a_inside_b = edges_inside(a_to_b, b_to_a);
  c.edges_of_b_inside_a = edges_inside(b_to_a, a_to_b);
}

Vec3d lerp(const Vec3d& p, const Vec3d& q, double t) { return p + (q - p) * t; }

/// Where an end's edge meets the plane.
Vec3d end_point(const ExactTriangle& t, const EdgeAtPlane& e, const ExactPlane& plane) {
  const double below = -plane.det(t.corner[at(e.from)]).value();
  const double above = plane.det(t.corner[at(e.to)]).value();
  return lerp(t.corner[at(e.from)].as<double>(), t.corner[at(e.to)].as<double>(),
              below / (below + above));
}

bool inside_projected(const EdgeSides& s, int corner) {
  return s[0][at(corner)] >= 0 && s[1][at(corner)] >= 0 && s[2][at(corner)] >= 0;
}

/// A common point of two coplanar triangles that meet: a corner of one in the other, or else a
/// crossing of two edges.
Vec3d coplanar_point(const ExactTriangle& a, const ExactTriangle& b) {
  const int axis = main_axis(a.plane.normal());
  const EdgeSides a_to_b = edge_sides(b, a, axis), b_to_a = edge_sides(a, b, axis);
  for (int i = 0; i < 3; ++i)
    if (inside_projected(a_to_b, i)) return a.corner[at(i)].as<double>();
  for (int i = 0; i < 3; ++i)
    if (inside_projected(b_to_a, i)) return b.corner[at(i)].as<double>();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const bool a_crosses = a_to_b[at(j)][at(i)] * a_to_b[at(j)][at(next_corner(i))] < 0;
      const bool b_crosses = b_to_a[at(i)][at(j)] * b_to_a[at(i)][at(next_corner(j))] < 0;
      if (!a_crosses || !b_crosses) continue;
      const Vec3l p = b.corner[at(j)], d = drop_axis(b.corner[at(next_corner(j))] - p, axis);
      const auto height = [&](int corner) {
        const Vec3d v = drop_axis(a.corner[at(corner)] - p, axis).as<double>();
        return std::fabs(static_cast<double>(d.x) * v.y - static_cast<double>(d.y) * v.x);
      };
      const double from = height(i), to = height(next_corner(i));
      return lerp(a.corner[at(i)].as<double>(), a.corner[at(next_corner(i))].as<double>(),
                  from / (from + to));
    }
  return a.corner[0].as<double>();
}

}  // namespace

TriangleContact contact(const ExactTriangle& a, const ExactTriangle& b) {
  TriangleContact c;
  c.side_a = sides_of(a, b.plane);
  if (all_positive(c.side_a) || all_negative(c.side_a)) return c;
  if (all_zero(c.side_a)) {
    common_plane(a, b, c);
    return c;
  }
  c.side_b = sides_of(b, a.plane);
  if (all_positive(c.side_b) || all_negative(c.side_b)) return c;
  cross_planes(a, b, c);
  return c;
}

std::array<EdgeAtPlane, 2> segment_ends(const ExactTriangle& a, const ExactTriangle& b,
                                        const TriangleContact& c) {
  const Section& sa = section(c.side_a);
  const Section& sb = section(c.side_b);
  const auto of_a = [](const End& e) { return EdgeAtPlane{false, e.from, e.to}; };
  const auto of_b = [](const End& e) { return EdgeAtPlane{true, e.from, e.to}; };
  const bool a_starts_last = order(a, sa.low, b, sb.high) <= 0;
  const bool a_ends_first = order(a, sa.high, b, sb.low) >= 0;
  return {a_starts_last ? of_a(sa.low) : of_b(sb.high),
          a_ends_first ? of_a(sa.high) : of_b(sb.low)};
}

Vec3d common_point(const ExactTriangle& a, const ExactTriangle& b, const TriangleContact& c) {
  if (c.coplanar) return coplanar_point(a, b);
  const auto at = [&](const EdgeAtPlane& end) {
    return end.of_b ? end_point(b, end, a.plane) : end_point(a, end, b.plane);
  };
  const auto [low, high] = segment_ends(a, b, c);
  return lerp(at(low), at(high), 0.5);
}

}  // namespace strake::geometry
