// SPDX-License-Identifier: Apache-2.0
// The convex polygons by which parts hide, and how they are merged from triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hlr/occluders/silhouette_loops.hpp"
#include "hlr/view/perspective_map.hpp"
#include "hlr/view/projection.hpp"
#include "strake/core/result.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/parallel/context.hpp"

namespace strake::hlr {

struct PaperCorner {
  std::int64_t u = 0, v = 0;
};

/// A planar convex polygon that hides what lies behind it: a triangle, or exactly coplanar
/// neighbours whose union is convex on paper. Corners run counter-clockwise to the viewer. It hides
/// the union of what its triangles hide, ends included.
struct OccluderPolygon {
  ViewBox box;
  geometry::Vec3i at;                    ///< a corner
  bool edge_on = false;                  ///< edge-on but for rounding: see may_be_edge_on()
  bool back = false;                     ///< its triangles are wound clockwise to the viewer
  std::array<std::int64_t, 3> normal{};  ///< points to the viewer's side; unused where wide >= 0
  std::int32_t wide = -1;                ///< index into OccluderPolygons::wide_normals
  std::uint32_t first_corner = 0, corners = 0;
  std::uint32_t part = 0;
};

/// Polygons with the corners, rays and normals that they refer to.
struct OccluderPolygons {
  std::vector<OccluderPolygon> polygons;  ///< sorted by part
  std::vector<PaperCorner> corners;       ///< orthographic
  std::vector<geometry::Vec3l> rays;      ///< perspective: corners relative to the eye
  std::vector<ExactNormal> wide_normals;

  [[nodiscard]] ExactNormal normal(const OccluderPolygon& p) const {
    if (p.wide >= 0) return wide_normals[static_cast<std::size_t>(p.wide)];
    return {p.normal[0], p.normal[1], p.normal[2]};
  }
};

/// Makes polygons of the triangles of a part, for one worker; it keeps its memory.
class OccluderBuilder {
 public:
  /// `perspective_map`: null where the view is orthographic.
  OccluderBuilder(const ProjectedPart& projected, std::uint32_t part_index,
                  const PerspectiveMap* perspective_map)
      : projected_(projected),
        part_index_(part_index),
        perspective_map_(perspective_map),
        loops_(projected) {}

  /// Adds coplanar triangles that look the same way and of which all, or none, may be edge-on: as
  /// one polygon if that is convex, or else each.
  void add_group(std::span<const std::uint32_t> triangles, OccluderPolygons& out);
  /// Adds a triangle of a part that is too wide for narrow normals, unless it is seen edge-on.
  void add_wide(std::uint32_t triangle, OccluderPolygons& out);
  /// Makes the outline of a certified convex part: appends its corners and fills the polygon. False
  /// where it is not one convex loop.
  [[nodiscard]] bool make_outline(OccluderPolygon& outline, OccluderPolygons& out);

 private:
  OccluderPolygon& start(std::uint32_t vertex, OccluderPolygons& out) const;
  void add_found(std::uint32_t triangle, OccluderPolygons& out);
  void add_corners(OccluderPolygon& p, std::span<const std::uint32_t> vertices,
                   OccluderPolygons& out) const;

  const ProjectedPart& projected_;
  std::uint32_t part_index_;
  const PerspectiveMap* perspective_map_;
  SilhouetteLoops loops_;
};

/// Appends polygons that were made run by run, none of them by add_wide. Errors: cancelled.
[[nodiscard]] Status append(OccluderPolygons& all, std::span<const OccluderPolygons> runs,
                            const parallel::Context& context);

}  // namespace strake::hlr
