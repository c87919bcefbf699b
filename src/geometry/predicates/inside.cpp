// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/inside.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/predicates/line_clip.hpp"
#include "geometry/predicates/ray_crossing.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

/// Sign of the 2D orientation of a, b and the point, seen along `axis`.
int turn2d(const Vec3l& a, const Vec3l& b, const ScaledPoint& p, int axis) {
  const Vec3l u = drop_axis(b - a, axis), v = drop_axis(p.from(a), axis);
  // Far above what rounding four numbers, two products and their difference is off by.
  constexpr double kRounding = 1e-15;
  const double left = static_cast<double>(u.x) * static_cast<double>(v.y);
  const double right = static_cast<double>(u.y) * static_cast<double>(v.x);
  const double turn = left - right;
  if (std::fabs(turn) > kRounding * (std::fabs(left) + std::fabs(right))) return turn > 0 ? 1 : -1;
  return sign_of(static_cast<Int128>(u.x) * v.y - static_cast<Int128>(u.y) * v.x);
}

/// The same for the point moved by (e1, e2), 0 < e2 << e1 << 1: never zero unless the edge runs
/// along `axis`. All triangles round a common edge see the same move, so a ray meets each surface
/// consistently however it hits edges and vertices.
int moved_turn2d(const Vec3l& a, const Vec3l& b, const ScaledPoint& p, int axis) {
  const int turn = turn2d(a, b, p, axis);
  if (turn != 0) return turn;
  const Vec3l u = drop_axis(b - a, axis);
  if (u.y != 0) return u.y > 0 ? -1 : 1;
  return (u.x > 0) - (u.x < 0);
}

/// The place of a point of the triangle's plane, given the triangle's normal.
FeatureMask place_in_plane(const TriangleCorners& t, const Vec3<Int128>& normal,
                           const ScaledPoint& p) {
  const int projection_axis = any_axis(normal);
  if (projection_axis < 0) return 0;
  const int facing = sign_of(normal[projection_axis]);
  unsigned on_edges = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const int turn = facing * turn2d(t[i], t[next_corner(i)], p, projection_axis);
    if (turn < 0) return 0;
    if (turn == 0) on_edges |= 1U << i;
  }
  return place_of(on_edges);
}

int side_of_plane(const TriangleCorners& t, const Vec3<Int128>& normal, const ScaledPoint& p) {
  return sign_of(dot(normal, p.from(t[0]).as<Int128>()));
}

/// Seen along the axis: whether the point lies on the edge.
bool on_edge(const Vec3l& a, const Vec3l& b, const ScaledPoint& p, int axis) {
  if (turn2d(a, b, p, axis) != 0) return false;
  const Vec3l from_a = drop_axis(p.from(a), axis), from_b = drop_axis(p.from(b), axis);
  const auto between = [](std::int64_t x, std::int64_t y) {
    return (x <= 0 && y >= 0) || (x >= 0 && y <= 0);
  };
  return between(from_a.x, from_b.x) && between(from_a.y, from_b.y);
}

/// Whether a ray along the first direction of the view, just above the point, meets the edge.
bool crosses_ray(const Vec3l& a, const Vec3l& b, const ScaledPoint& p, int axis) {
  const bool a_above = drop_axis(p.from(a), axis).y < 0, b_above = drop_axis(p.from(b), axis).y < 0;
  return a_above != b_above && (turn2d(a, b, p, axis) > 0) == b_above;
}

}  // namespace

FeatureMask feature_of(const TriangleCorners& t, const ScaledPoint& p) {
  const Vec3<Int128> normal = cross_exact(t[1] - t[0], t[2] - t[0]);
  return side_of_plane(t, normal, p) == 0 ? place_in_plane(t, normal, p) : FeatureMask{0};
}

PointSide side_of_polygon(std::span<const Vec3l> points, std::span<const std::uint32_t> first,
                          int axis, const ScaledPoint& p) {
  bool inside = false;
  for (std::size_t c = 0; c + 1 < first.size(); ++c) {
    const std::span<const Vec3l> contour = points.subspan(first[c], first[c + 1] - first[c]);
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const Vec3l &a = contour[i], &b = contour[i + 1 == contour.size() ? 0 : i + 1];
      if (on_edge(a, b, p, axis)) return PointSide::on_boundary;
      inside ^= crosses_ray(a, b, p, axis);
    }
  }
  return inside ? PointSide::inside : PointSide::outside;
}

bool RayCrossings::pass(const TriangleCorners& t) {
  // Most triangles end here: the ray goes past them. The exact normal is what takes the time.
  const auto box = box_of(t);
  if (!may_meet(box.lo, box.hi)) return true;
  const int x = turn2d(t[0], t[1], point_, axis_), y = turn2d(t[1], t[2], point_, axis_),
            z = turn2d(t[2], t[0], point_, axis_);
  if (std::min({x, y, z}) < 0 && std::max({x, y, z}) > 0) return true;
  const Vec3<Int128> normal = cross_exact(t[1] - t[0], t[2] - t[0]);
  const int side = side_of_plane(t, normal, point_);
  // A ray within the plane of a triangle does not cross it.
  if (side == 0) return place_in_plane(t, normal, point_) == 0;
  const int facing = sign_of(normal[axis_]);
  if (facing == 0 || (side * facing < 0) != upward_) return true;
  for (std::size_t i = 0; i < 3; ++i)
    if (moved_turn2d(t[i], t[next_corner(i)], point_, axis_) != facing) return true;
  number_ += upward_ ? facing : -facing;
  return true;
}

PointSide side_of_polyhedron(const Part& part, const ScaledPoint& p) {
  RayCrossings winding(p, 0, true);
  const auto corner = [&](std::uint32_t v) { return part.vertices[v].as<std::int64_t>(); };
  for (const Triangle& t : part.triangles)
    if (!winding.pass({corner(t[0]), corner(t[1]), corner(t[2])})) return PointSide::on_boundary;
  const bool inside = part.kind == PartKind::solid && winding.number() >= 1;
  return inside ? PointSide::inside : PointSide::outside;
}

}  // namespace strake::geometry
