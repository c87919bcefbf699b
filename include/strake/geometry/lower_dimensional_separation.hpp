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
/// Apart d is the distance, touching 0. Where part of the thin body lies in the inside of a solid,
/// d = -D, with D the greatest distance to the solid's skin of a point that it has there. Where a
/// line or polyline passes through a sheet from one side to the other, D is the distance of that
/// place to the sheet's rim or to the line's own ends, whichever is smaller. All else that meets
/// sheets, and thin bodies that meet each other, touch: d is 0. Where a work limit leaves the
/// bracket wide, d is as deep as the points show.
struct LowerDimensionalSeparation {
  double d = 0, lower = 0, upper = std::numeric_limits<double>::infinity();
  /// Apart: the closest points, `upper` apart. In a solid, the deepest point found and the nearest
  /// point of the skin; through a sheet, twice the place. Relative to the thin body's origin (that
  /// of the first).
  Vec3d on_body, on_other;
  bool inside = false;         ///< part of it is certainly inside: lower and upper are negative
  bool depth_complete = true;  ///< as Depth::complete
  /// Inside: how deep all of it lies inside; negative or 0: part of it does not.
  double wholly_inside = 0;
};

/// Two thin bodies. Exact to the last rounding where neither has an arc (closest_points() between
/// their pieces); with arcs by the solver of iterative_separation(), a tenth of a unit wide unless
/// two arcs run along each other. Where they are at least `enough` apart the answer may be any
/// certain lower bound from `enough` up.
[[nodiscard]] LowerDimensionalSeparation lower_dimensional_separation(
    const LowerDimensionalBody& a, const LowerDimensionalBody& b,
    double enough = std::numeric_limits<double>::infinity());

/// A thin body and a primitive's true surface, by the certified solver: a fraction of a unit wide.
/// Crossing a primitive that has no thickness is touching here: its mesh knows more. Nothing for
/// primitives that iterative_separation() leaves out.
[[nodiscard]] std::optional<LowerDimensionalSeparation> lower_dimensional_separation(
    const LowerDimensionalBody& thin, const PlacedPrimitive& primitive,
    double enough = std::numeric_limits<double>::infinity());

/// A thin body and a mesh, as its triangles are. Distances are exact but for arcs; depths come from
/// a branch and bound over the pieces that stops as `goal` says, halves of an arc being measured
/// along their chords, with their sagitta in the bracket.
[[nodiscard]] LowerDimensionalSeparation lower_dimensional_separation(
    const LowerDimensionalBody& thin, const PartWithBvh& mesh, const DepthOptions& goal,
    QueryContext& work, double enough = std::numeric_limits<double>::infinity());

}  // namespace strake::geometry
