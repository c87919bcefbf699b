// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geometry/plane_section/plane_section.hpp"
#include "strake/geometry/mesh.hpp"
#include "strake/geometry/wide_int.hpp"

// Rounding of section points, triangulation of caps, and the outline of a section.

namespace strake::geometry::plane_section {

/// A point that may have been rounded to the grid.
struct RoundedPoint {
  Vec3l at;
  bool exact = true;
};

/// Returns num/den rounded to the nearest integer, ties away from zero; den > 0. Clears `exact`
/// where that rounds.
[[nodiscard]] constexpr std::int64_t rounded(Int128 num, Int128 den, bool& exact) {
  Int128 quotient = num / den;
  const Int128 rest = num % den;
  if (rest != 0) exact = false;
  if (2 * rest >= den) ++quotient;
  if (2 * rest <= -den) --quotient;
  return static_cast<std::int64_t>(quotient);
}

/// Returns where the segment between a point below the plane and one that is not meets it. The
/// result does not depend on which end is given first: the rational point is unique, and so is its
/// rounding.
[[nodiscard]] constexpr RoundedPoint meeting_point(const CutPlane& plane, const Vec3l& below,
                                                   const Vec3l& other) {
  const std::int64_t under = -plane.height(below), span = plane.height(other) + under;
  RoundedPoint p;
  for (int k = 0; k < 3; ++k)
    p.at[k] = rounded(
        static_cast<Int128>(below[k]) * span + static_cast<Int128>(other[k] - below[k]) * under,
        span, p.exact);
  return p;
}

/// Returns the point of the plane at (u, v), its third coordinate rounded.
[[nodiscard]] constexpr Vec3l on_plane(const CutPlane& plane, const PlaneAxes& axes, std::int64_t u,
                                       std::int64_t v) {
  Vec3l p;
  p[axes.u] = u;
  p[axes.v] = v;
  const Int128 rest = static_cast<Int128>(plane.offset) -
                      static_cast<Int128>(plane.normal[axes.u]) * u -
                      static_cast<Int128>(plane.normal[axes.v]) * v;
  const std::int64_t n = plane.normal[axes.w];
  bool exact = true;
  p[axes.w] = rounded(n < 0 ? -rest : rest, n < 0 ? -n : n, exact);
  return p;
}

/// A directed edge from one vertex to another.
using Directed = std::array<std::uint32_t, 2>;

/// Appends to `triangles` the area that the oriented outline surrounds with a winding number that
/// is not zero, and to `vertices` the new ones where lines cross. Returns false, and appends
/// nothing, where the outline is not closed or too crooked to be triangulated on the grid.
[[nodiscard]] bool triangulate_cap(const CutPlane& plane, std::span<const Directed> outline,
                                   std::vector<Vec3l>& vertices, std::vector<Triangle>& triangles);

/// The edge at which a plane cuts one triangle, in the triangle's orientation.
struct OutlineSegment {
  Directed ends{};
  std::uint32_t triangle = 0;
};

struct SectionOutline {
  std::vector<Segment> lines;   ///< each once, ascending ends, in no order
  std::uint32_t open_ends = 0;  ///< vertices where an odd number of segments meet
};

/// Returns the lines of a section: collinear segments in one plane are merged, and of coincident
/// segments one is kept. `coplanar(s, t)` says whether two triangles lie in one plane and face one
/// way.
[[nodiscard]] SectionOutline find_outline(
    std::vector<OutlineSegment> segments, std::span<const Vec3l> vertices,
    const std::function<bool(std::uint32_t, std::uint32_t)>& coplanar);

}  // namespace strake::geometry::plane_section
