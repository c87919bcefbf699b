// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/vec.hpp"

// Clipping of triangles by slabs, for the extent of an overlap.

namespace strake::geometry {

/// The points with lo <= axis · p <= hi.
struct Slab {
  Vec3d axis;
  double lo = 0, hi = 0;
};

/// Returns the box of the part of a triangle in three slabs, clipped by one plane after the other.
/// Empty where nothing lies in them.
[[nodiscard]] inline Box3d box_of_clipped(const Corners& t, const std::array<Slab, 3>& slabs) {
  struct ClippedPolygon {
    std::array<Vec3d, 9> corner;  // a plane adds one at most
    std::size_t size = 0;
    void add(const Vec3d& p) { corner[size++] = p; }
  };
  ClippedPolygon polygon;
  for (const Vec3d& p : t) polygon.add(p);
  for (const Slab& slab : slabs)
    for (const double sign : {1.0, -1.0}) {
      const double limit = sign > 0 ? slab.hi : -slab.lo;
      ClippedPolygon cut;
      for (std::size_t i = 0; i < polygon.size; ++i) {
        const Vec3d &p = polygon.corner[i], &q = polygon.corner[(i + 1) % polygon.size];
        const double beyond_p = sign * dot(slab.axis, p) - limit;
        const double beyond_q = sign * dot(slab.axis, q) - limit;
        if (beyond_p <= 0) cut.add(p);
        if ((beyond_p > 0) != (beyond_q > 0))
          cut.add(p + (q - p) * (beyond_p / (beyond_p - beyond_q)));
      }
      polygon = cut;
    }
  return box_of(std::span(polygon.corner).first(polygon.size));
}

/// Grid units: rounding may clip off this much of a triangle, so boxes of the overlap are grown by
/// it.
inline constexpr double kCutMargin = 1;

/// Adds what of either of two triangles lies within reach of the other to a box: at most the
/// intersection of their boxes, each grown by reach and margin.
void include_overlap(const TriangleCorners& a, const TriangleCorners& b, double reach,
                     Box3d& extent);

}  // namespace strake::geometry
