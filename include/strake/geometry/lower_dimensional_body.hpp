// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "strake/geometry/mesh.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/triangulate.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A circular arc of radius `radius_mm` in the XY plane of its placement, from +X counter-clockwise
/// about +Z by `angle` radians (at most a full circle counts).
struct CircularArc {
  double radius_mm = 0, angle = 0;
  Placement placement;
};

/// A body without thickness: points, lines, polylines, polygons and arcs, any number of each.
///
/// Vertices lie on the grid, relative to `origin`, so that points, segments and polygons are exact;
/// arcs are as given, but for the snap of their centres, as with primitives. Make one by the
/// functions below; lower_dimensional_separation.hpp measures distances.
struct LowerDimensionalBody {
  Vec3l origin;
  std::vector<Vec3i> vertices;
  std::vector<std::uint32_t> points;  ///< vertices that are points of their own
  std::vector<std::array<std::uint32_t, 2>> segments;
  std::vector<Triangle> triangles;  ///< the triangles of polygons
  std::vector<CircularArc> arcs;

  [[nodiscard]] std::size_t pieces() const {
    return points.size() + segments.size() + triangles.size() + arcs.size();
  }
};

/// Makes a point; nothing where it lies beyond the grid. Coordinates here are world millimetres.
[[nodiscard]] std::optional<LowerDimensionalBody> make_point_body(const Vec3d& p);

/// Makes the segments between consecutive points, and from the last to the first where closed.
/// Points that the snap merges count once; a single one left makes a point. Nothing where a point
/// lies beyond the grid, where the points span more than 2^31 units, or without points.
[[nodiscard]] std::optional<LowerDimensionalBody> make_polyline_body(std::span<const Vec3d> points,
                                                                     bool closed = false);

/// A planar, or nearly planar, polygon with holes, by its triangles: see triangulate_face(), whose
/// faults are the errors. The fault `not_finite` also stands for points beyond the grid.
struct PolygonBody {
  LowerDimensionalBody body;
  FaceFault fault = FaceFault::none;
};
[[nodiscard]] PolygonBody make_polygon_body(std::span<const Vec3d> points,
                                            std::span<const std::uint32_t> first);

/// Makes an arc whose placement is a similarity; nothing for other placements (an uneven scale
/// makes an ellipse), for a radius or angle that is not positive and finite, and beyond the grid.
[[nodiscard]] std::optional<LowerDimensionalBody> make_arc_body(const CircularArc& arc);

/// Makes a body of the chains of a placed wire part.
[[nodiscard]] LowerDimensionalBody make_wire_body(const PlacedPart& wire);

}  // namespace strake::geometry
