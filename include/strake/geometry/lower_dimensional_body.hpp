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
/// about +Z by `angle` radians (at most a full turn counts).
struct CircularArc {
  double radius_mm = 0, angle = 0;
  Placement placement;
};

/// A body without thickness: points, lines, polylines, polygons and arcs, any number of each.
///
/// Corners stand on the grid, relative to `origin`, so that whatever has corners is exact; arcs are
/// what their numbers say, but for the snap of their centres, as with primitives. Start with one of
/// the functions below; thin_pair.hpp measures.
struct LowerDimensionalBody {
  Vec3l origin;
  std::vector<Vec3i> vertices;
  std::vector<std::uint32_t> points;  ///< vertices that are points of their own
  std::vector<std::array<std::uint32_t, 2>> segments;
  std::vector<Triangle> triangles;  ///< the pieces of polygons
  std::vector<CircularArc> arcs;

  [[nodiscard]] std::size_t pieces() const {
    return points.size() + segments.size() + triangles.size() + arcs.size();
  }
};

/// A point; nothing where it has no place on the grid. Coordinates here are world millimetres.
[[nodiscard]] std::optional<LowerDimensionalBody> make_point_body(const Vec3d& p);

/// The segments between consecutive points, and from the last to the first where closed. Points
/// that the snap makes one count once; what is left of a single one is a point. Nothing where a
/// point has no place, where it spans more than 2^31 units, or without points.
[[nodiscard]] std::optional<LowerDimensionalBody> make_polyline_body(std::span<const Vec3d> points,
                                                                     bool closed = false);

/// A planar, or nearly planar, polygon with holes, by its triangles: see triangulate_face(), whose
/// faults are the errors. A fault of `not_finite` also stands for points without a place.
struct PolygonBody {
  LowerDimensionalBody body;
  FaceFault fault = FaceFault::none;
};
[[nodiscard]] PolygonBody make_polygon_body(std::span<const Vec3d> points,
                                            std::span<const std::uint32_t> first);

/// An arc whose placement is a similarity; nothing for others (an uneven scale makes an ellipse),
/// for a radius or angle that is not positive and finite, and without a place on the grid.
[[nodiscard]] std::optional<LowerDimensionalBody> make_arc_body(const CircularArc& arc);

/// The chains of a wire part where it stands.
[[nodiscard]] LowerDimensionalBody make_wire_body(const PlacedPart& wire);

}  // namespace strake::geometry
