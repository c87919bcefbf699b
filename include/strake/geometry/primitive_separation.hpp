// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0008 says why supports, cutting planes and multipliers solve these pairs.

#include <algorithm>
#include <limits>
#include <optional>

#include "strake/geometry/part_pair.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A primitive and the placement of its body; the translation counts as snapped to the grid.
struct PlacedPrimitive {
  const Primitive* primitive = nullptr;
  const Placement* placement = nullptr;
};

/// Signed separation of two true surfaces, without tessellation. All lengths are grid units.
struct PrimitiveSeparation {
  double d = 0;                 ///< distance, or minus the depth D of docs/clash.md
  double lower = 0, upper = 0;  ///< certain bracket of d
  Vec3d point;  ///< midpoint of the closest pair or deepest point, relative to a's snapped centre
  /// Unit direction in which a moves away from b. Apart, the closest points are point ± away·d/2,
  /// a's first. Otherwise the deepest point comes out when a moves D in this direction: the nearest
  /// surface point that d is measured to is point - away·D where `deep_in_a`, else point + away·D.
  Vec3d away{1, 0, 0};
  bool deep_in_a = false;
  /// How deep one lies wholly inside the other; negative where it protrudes by that much or is not
  /// known to lie inside.
  double a_inside_b = -std::numeric_limits<double>::infinity();
  double b_inside_a = -std::numeric_limits<double>::infinity();
  /// Bound on how far the two surfaces lie apart: 0 for duplicates.
  double difference = std::numeric_limits<double>::infinity();
  bool sheet_a = false,
       sheet_b = false;        ///< this one has no thickness: depth is measured in the other
  bool depth_complete = true;  ///< no work limit ended a search for the depth

  /// Returns a certain bound on the error of d.
  [[nodiscard]] double error() const { return std::max(d - lower, upper - d); }
};

/// Returns the signed separation of two true surfaces within a certain bracket, for boxes,
/// pyramids, cylinders, snouts, spheres and dishes under any placement that does not flatten them,
/// tori under similarities. Nothing for lines, for tubes that reach beyond their axis, for a snout
/// whose end planes intersect inside it, for sheets of a torus that meet the other and for two
/// sheets that meet: their triangles decide.
///
/// Closed forms where there are any (a sphere and a sphere, cylinder or box; cylinders with
/// parallel axes), otherwise iterative_separation(). The bracket is a fraction of a grid unit wide,
/// but for bodies whose rounded matrices a closed form or a torus has orthonormalised, and for
/// rings that run along the other body for long: d is then the value at the points found, a touch
/// where these show no overlap.
///
/// Where the two are at least `cutoff` apart the result may be any certain lower bound from
/// `cutoff` up, with a bracket of no width.
[[nodiscard]] std::optional<PrimitiveSeparation> primitive_separation(
    const PlacedPrimitive& a, const PlacedPrimitive& b,
    double cutoff = std::numeric_limits<double>::infinity());

/// Returns the signed separation without closed forms, as the reference for them. Apart: a
/// separating plane bounds it from below, a pair of points from above (Gilbert, Johnson and Keerthi
/// 1988). Overlapping: a linear program over all half-spaces of both by cutting planes (Kelley
/// 1960), bounded by its multipliers from above and by a point of certain depth from below.
[[nodiscard]] std::optional<PrimitiveSeparation> iterative_separation(
    const PlacedPrimitive& a, const PlacedPrimitive& b,
    double cutoff = std::numeric_limits<double>::infinity());

/// The distance of a primitive's true body and the triangles of a mesh, grid units: lower <=
/// distance <= upper is certain. A mesh that encloses the primitive is as far away as its
/// triangles.
struct PrimitiveMeshDistance {
  double lower = std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  Vec3d on_primitive, on_mesh;  ///< `upper` apart, relative to the mesh's origin
};

/// Returns the distance by convex hulls and triangles as in iterative_separation(), driven by the
/// mesh's BVH. Where no triangle is nearer than `cutoff`, lower is at least that. Nothing for
/// primitives that iterative_separation() leaves out.
[[nodiscard]] std::optional<PrimitiveMeshDistance> primitive_mesh_distance(
    const PlacedPrimitive& primitive, const PartWithBvh& mesh,
    double cutoff = std::numeric_limits<double>::infinity());

}  // namespace strake::geometry
