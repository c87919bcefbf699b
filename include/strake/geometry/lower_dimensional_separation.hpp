// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0011 says why a line is the limit of a thin rod, and is not compared by default.

#include <limits>
#include <optional>

#include "strake/geometry/depth.hpp"
#include "strake/geometry/lower_dimensional_body.hpp"
#include "strake/geometry/part_pair.hpp"
#include "strake/geometry/primitive_separation.hpp"

namespace strake::geometry {

/// Signed separation of a body without thickness and another body, grid units: lower <= d <= upper
/// is certain.
///
/// Where the two are apart, d is their distance; where they touch, d is 0. Where the body without
/// thickness lies partly inside a solid, d = -D, with D the greatest distance to the solid's
/// surface of a point of it in there. Where a line or polyline pierces a sheet from one side to the
/// other, D is the distance of that point to the sheet's border or to the line's own ends,
/// whichever is smaller. Everything else that meets a sheet, and two bodies without thickness that
/// meet, touch: d is 0. Where a work limit leaves the bracket wide, d is the depth of the points
/// found.
struct LowerDimensionalSeparation {
  double d = 0, lower = 0, upper = std::numeric_limits<double>::infinity();
  /// Apart: the closest points, `upper` apart. In a solid: the deepest point found and the nearest
  /// point of the surface. Through a sheet: twice the piercing point. Relative to the origin of the
  /// (first) body without thickness.
  Vec3d on_body, on_other;
  bool inside = false;  ///< part of the body is certainly inside: lower and upper are negative
  bool depth_complete = true;  ///< as Depth::complete
  /// Depth at which the whole body lies inside; negative or 0 where part of it does not.
  double wholly_inside = 0;
};

/// Returns the separation of two bodies without thickness. It is exact to the last rounding where
/// neither has an arc (closest_points() between their simplices); arcs take the solver of
/// iterative_separation(), whose bracket is a tenth of a unit wide unless two arcs run along each
/// other. Where they are at least `cutoff` apart the answer may be any certain lower bound from
/// `cutoff` up.
[[nodiscard]] LowerDimensionalSeparation lower_dimensional_separation(
    const LowerDimensionalBody& a, const LowerDimensionalBody& b,
    double cutoff = std::numeric_limits<double>::infinity());

/// Returns the separation from a primitive's true surface, by the certified solver: the bracket is
/// a fraction of a unit wide. Crossing a primitive that has no thickness counts as touching here;
/// its mesh gives more. Nothing for primitives that iterative_separation() leaves out.
[[nodiscard]] std::optional<LowerDimensionalSeparation> lower_dimensional_separation(
    const LowerDimensionalBody& thin, const PlacedPrimitive& primitive,
    double cutoff = std::numeric_limits<double>::infinity());

/// Returns the separation from the triangles of a mesh. Distances are exact but for arcs; depths
/// come from a branch and bound over the simplices that stops as `goal` says, halves of an arc
/// being measured along their chords, with their sagitta in the bracket.
[[nodiscard]] LowerDimensionalSeparation lower_dimensional_separation(
    const LowerDimensionalBody& thin, const PartWithBvh& mesh, const DepthOptions& goal,
    QueryContext& work, double cutoff = std::numeric_limits<double>::infinity());

}  // namespace strake::geometry
