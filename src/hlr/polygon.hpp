// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hlr/frame.hpp"
#include "hlr/viewer.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::hlr {

struct Corner {
  std::int64_t u = 0, v = 0;
};

/// A planar convex piece of a surface that hides what lies behind it: a triangle, or exactly
/// coplanar neighbours whose union is convex on paper. Corners run counter-clockwise to the
/// viewer. What it hides is the union of what its triangles hide, ends included.
struct Polygon {
  ViewBox box;
  geometry::Vec3i at;                    ///< a corner
  bool edge_on = false;                  ///< but for rounding: see may_be_edge_on()
  std::array<std::int64_t, 3> normal{};  ///< to the viewer's side; unused where wide >= 0
  std::int32_t wide = -1;                ///< index into Polygons::wide_normals
  std::uint32_t first_corner = 0, corners = 0;
  std::uint32_t part = 0;
};

/// Polygons with what they refer to.
struct Polygons {
  std::vector<Polygon> polygons;      ///< by part
  std::vector<Corner> corners;        ///< orthographic
  std::vector<geometry::Vec3l> rays;  ///< in perspective: corners relative to the eye
  std::vector<NormalVector> wide_normals;

  [[nodiscard]] NormalVector normal(const Polygon& p) const {
    if (p.wide >= 0) return wide_normals[static_cast<std::size_t>(p.wide)];
    return {p.normal[0], p.normal[1], p.normal[2]};
  }
};

}  // namespace strake::hlr
