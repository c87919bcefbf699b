// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/intersect.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "geometry/numeric/triangle_math.hpp"
#include "geometry/predicates/line_clip.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

/// Returns the height of the line's points over a plane, times the length of its normal.
AffineFunction height(const GridLine& line, const Vec3<Int128>& normal, const Vec3l& on_plane) {
  return {dot(normal, (line.from - on_plane).as<Int128>()),
          dot(normal, (line.to - on_plane).as<Int128>())};
}

/// Inside of the triangle's edges, seen along an axis along which the triangle does not vanish.
std::array<AffineFunction, 3> inside_edges(const GridLine& line, const TriangleCorners& t,
                                           int axis) {
  const int turn = orient2d(t[0], t[1], t[2], axis);
  std::array<AffineFunction, 3> r;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3l e = drop_axis(t[next_corner(i)] - t[i], axis);
    const auto left = [&](const Vec3l& p) {
      const Vec3l d = drop_axis(p - t[i], axis);
      return (static_cast<Int128>(e.x) * d.y - static_cast<Int128>(e.y) * d.x) * turn;
    };
    r[i] = {left(line.from), left(line.to)};
  }
  return r;
}

void in_triangles_plane(const GridLine& line, const TriangleCorners& t, int axis,
                        LineInTriangle& r) {
  r.coplanar = true;
  HalfSpaceClip clip(line);
  const std::array<AffineFunction, 3> inside = inside_edges(line, t, axis);
  for (const AffineFunction& f : inside) clip.keep(f);
  r.at = clip.result();
  if (r.at.touch == Touch::none) return;
  const auto place = [&](const Rational& at) {
    unsigned on_edges = 0;
    for (unsigned i = 0; i < 3; ++i)
      if (inside[i].sign_at(at) == 0) on_edges |= 1U << i;
    return place_of(on_edges);
  };
  r.feature_first = place(r.at.first);
  r.feature_last = place(r.at.last);
}

/// num / den with a positive denominator.
Rational fraction(Int128 num, Int128 den) {
  return den < 0 ? Rational{-num, -den} : Rational{num, den};
}

bool reaches(const GridLine& line, const Rational& at) {
  if (line.reach != LineKind::line && at.num < 0) return false;
  return line.reach != LineKind::segment || at.num <= at.den;
}

/// Lines that are not parallel meet in a point or not at all.
void cross(const GridLine& a, const GridLine& b, const Vec3<Int128>& normal, LineMeeting& r) {
  const Vec3l e = a.to - a.from, f = b.to - b.from, d = b.from - a.from;
  if (dot(normal, d.as<Int128>()) != 0) return;
  r.coplanar = true;
  const int axis = any_axis(normal);
  const Rational s = fraction(cross_exact(d, f)[axis], normal[axis]);
  const Rational t = fraction(cross_exact(d, e)[axis], normal[axis]);
  if (!reaches(a, s) || !reaches(b, t)) return;
  r.touch = Touch::point;
  r.first_a = r.last_a = s;
  r.first_b = r.last_b = t;
}

/// Where the point of `of` at a parameter lies on another line of the same points, along an axis
/// along which that one does not vanish.
Rational carried(const GridLine& of, const Rational& at, const GridLine& onto, int axis) {
  const std::int64_t e = of.to[axis] - of.from[axis], f = onto.to[axis] - onto.from[axis];
  if (at.den == 0) return {(e < 0) == (f < 0) ? at.num : -at.num, 0};
  const Int128 from = of.from[axis] - onto.from[axis];
  return fraction(from * at.den + at.num * e, at.den * f);
}

/// Intersects collinear lines: the common interval is found on the one that has a length.
void overlap(const GridLine& a, const GridLine& b, int axis, LineMeeting& r) {
  HalfSpaceClip clip(a);
  const auto keep = [&](std::int64_t bound, int way) {
    clip.keep({(Int128{a.from[axis]} - bound) * way, (Int128{a.to[axis]} - bound) * way});
  };
  const int way = b.to[axis] < b.from[axis] ? -1 : 1;
  const bool point = b.from == b.to;
  if (b.reach != LineKind::line || point) keep(b.from[axis], way);
  if (b.reach == LineKind::segment || point) keep(b.to[axis], -way);
  const LineStretch s = clip.result();
  r.touch = s.touch;
  if (s.touch == Touch::none) return;
  r.first_a = s.first;
  r.last_a = s.last;
  if (point) return;
  r.first_b = carried(a, s.first, b, axis);
  r.last_b = carried(a, s.last, b, axis);
}

}  // namespace

LineInPlane intersect_plane(const GridLine& line, const TriangleCorners& plane) {
  const Vec3<Int128> normal = cross_exact(plane[1] - plane[0], plane[2] - plane[0]);
  assert(any_axis(normal) >= 0);
  const AffineFunction off = height(line, normal, plane[0]);
  HalfSpaceClip clip(line);
  clip.keep(off);
  clip.keep({-off.at_0, -off.at_1});
  return {clip.result(), sign_of(off.at_0), sign_of(off.at_1)};
}

LineInTriangle intersect(const GridLine& line, const TriangleCorners& t) {
  const LineInPlane plane = intersect_plane(line, t);
  LineInTriangle r;
  r.side_from = plane.side_from;
  r.side_to = plane.side_to;
  if (plane.at.touch == Touch::none) return r;
  const Vec3<Int128> normal = cross_exact(t[1] - t[0], t[2] - t[0]);
  if (plane.side_from == 0 && plane.side_to == 0) {
    in_triangles_plane(line, t, any_axis(normal), r);
    return r;
  }
  unsigned on_edges = 0;
  int facing = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const int turn = orient3d(line.from, line.to, t[i], t[next_corner(i)]);
    if (turn == 0) on_edges |= 1U << i;
    if (turn * facing < 0) return r;
    if (turn != 0) facing = turn;
  }
  r.at = plane.at;
  r.feature_first = r.feature_last = place_of(on_edges);
  return r;
}

LineInBox intersect(const GridLine& line, const Box3l& box) {
  assert(!box.empty());
  std::array<AffineFunction, 6> inside;
  HalfSpaceClip clip(line);
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(2 * k);
    inside[i] = {line.from[k] - box.lo[k], line.to[k] - box.lo[k]};
    inside[i + 1] = {box.hi[k] - line.from[k], box.hi[k] - line.to[k]};
    clip.keep(inside[i]);
    clip.keep(inside[i + 1]);
  }
  LineInBox r{.at = clip.result()};
  if (r.at.touch == Touch::none) return r;
  r.through_inside = r.at.touch == Touch::segment || line.from == line.to;
  for (unsigned i = 0; i < 6; ++i) {
    if (inside[i].at_0 == 0 && inside[i].at_1 == 0) r.through_inside = false;
    if (r.at.first.den != 0 && inside[i].sign_at(r.at.first) == 0) r.feature_first |= 1U << i;
    if (r.at.last.den != 0 && inside[i].sign_at(r.at.last) == 0) r.feature_last |= 1U << i;
  }
  return r;
}

LineMeeting intersect(const GridLine& a, const GridLine& b) {
  LineMeeting r;
  const Vec3l e = a.to - a.from, f = b.to - b.from, d = b.from - a.from;
  const Vec3<Int128> normal = cross_exact(e, f);
  if (any_axis(normal) >= 0) {
    cross(a, b, normal, r);
    return r;
  }
  r.coplanar = r.parallel = true;
  const bool b_is_longer = a.from == a.to;
  const Vec3l& way = b_is_longer ? f : e;
  const int axis = any_axis(way.as<Int128>());
  if (axis < 0) {
    r.touch = a.from == b.from ? Touch::point : Touch::none;
    return r;
  }
  if (any_axis(cross_exact(way, d)) >= 0) return r;
  if (!b_is_longer) {
    overlap(a, b, axis, r);
    return r;
  }
  overlap(b, a, axis, r);
  std::swap(r.first_a, r.first_b);
  std::swap(r.last_a, r.last_b);
  return r;
}

RationalPoint point_at(const GridLine& line, const Rational& parameter) {
  assert(parameter.den > 0);
  return point_along(line.from, (line.to - line.from).as<Int128>(), WideInt<2>(parameter.num),
                     WideInt<2>(parameter.den));
}

Vec3l rounded_at(const GridLine& line, const Rational& parameter) {
  assert(parameter.den > 0);
  // The fraction is off by less than four roundings and the way by one more: below half a kRoom
  // within the range.
  constexpr double kRoom = 0x1p-16, kRange = 0x1p32;
  const double share = static_cast<double>(parameter.num) / static_cast<double>(parameter.den);
  const Vec3d way = (line.to - line.from).as<double>() * share;
  Vec3l rounded = line.from;
  for (int k = 0; k < 3; ++k) {
    const double below = std::floor(way[k]);
    const double off_a_tie = std::fabs(way[k] - below - 0.5);
    if (!(off_a_tie > kRoom && std::fabs(way[k]) < kRange))
      return point_at(line, parameter).rounded();
    rounded[k] += static_cast<std::int64_t>(std::floor(way[k] + 0.5));
  }
  return rounded;
}

}  // namespace strake::geometry
