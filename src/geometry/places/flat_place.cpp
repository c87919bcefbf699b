// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

#include "geometry/places/flat_end.hpp"
#include "strake/geometry/meeting_places.hpp"

// Two convex faces in one plane have one convex polygon in common, and two of one outline that
// outline. What else of either body comes within reach of the plane is a collar round its face; it
// leaves the plane steeply, so that it adds no more than a rim about as wide as the reach.

namespace strake::geometry {
namespace {

/// Whether the plane between two sides, square to the first one's way, has one place of both.
bool face_to_face(const Side& x, const Side& y, const FlatReach& near) {
  const double gap = dot(x.way, y.shift - x.shift) - y.top - x.top;
  if (!(gap >= -near.band && gap <= near.reach)) return false;
  const FlatPlane plane(x.way, near);
  const std::optional<FlatEnd> end_x = FlatEnd::of(x, plane);
  if (!end_x) return false;
  const std::optional<FlatEnd> end_y = FlatEnd::of(y, plane);
  if (!end_y) return false;
  return (end_x->is_convex() && end_y->is_convex()) || same_outline(*end_x, *end_y, plane, gap);
}

double top_along(const Part& part, const Vec3d& way) {
  double top = -std::numeric_limits<double>::infinity();
  for (const Vec3i& v : part.vertices) top = std::max(top, dot(way, v.as<double>()));
  return top;
}

/// By the axes of the first one's frame; `shift` takes the other's coordinates to the first one's.
bool along_frame(const FramedPart& of, const Part& other, const Vec3d& shift,
                 const FlatReach& near) {
  if (of.frame == nullptr) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d& axis = of.frame->axis[i];
    if (!(dot(axis, axis) > 0)) continue;  // a frame that was not made
    for (const double sign : {1.0, -1.0}) {
      const Vec3d way = axis * sign;
      const Side own{*of.placed.part, way, sign > 0 ? of.frame->hi[i] : -of.frame->lo[i], {}};
      if (face_to_face(own, {other, -way, top_along(other, -way), shift}, near)) return true;
    }
  }
  return false;
}

}  // namespace

bool in_one_flat_place(const FramedPart& a, const FramedPart& b, double reach) {
  const Part &x = *a.placed.part, &y = *b.placed.part;
  // Looking at each vertex would cost more than telling the places by a tree.
  if (std::max(x.vertices.size(), y.vertices.size()) >= kManyVertices) return false;
  const Vec3d shift = (b.placed.origin - a.placed.origin).as<double>();
  const FlatReach near(reach);
  for (int k = 0; k < 3; ++k)
    for (const double sign : {1.0, -1.0}) {
      Vec3d way;
      way[k] = sign;
      const Side of_a{x, way, sign > 0 ? x.box.hi[k] : -static_cast<double>(x.box.lo[k]), {}};
      const Side of_b{y, -way, sign > 0 ? -static_cast<double>(y.box.lo[k]) : y.box.hi[k], shift};
      if (face_to_face(of_a, of_b, near)) return true;
    }
  return along_frame(a, y, shift, near) || along_frame(b, x, -shift, near);
}

}  // namespace strake::geometry
