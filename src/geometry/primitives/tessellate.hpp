// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "strake/geometry/mesh.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A primitive as triangles (or, for a line, as a segment).
struct Tessellation {
  TriangleMesh mesh;  ///< millimetres under the given linear map; sag_mm is the certified bound
  Polylines lines;
  std::string_view fault;  ///< why there is nothing: "not finite", "no extent" …; empty when fine
};

/// Triangulates a primitive under the linear part of its placement, so that no triangle lies
/// farther than `sag_mm` from the true surface, nor the reverse, both measured after the map.
///
/// 1. The mesh is closed and oriented outward whatever the sign of the map's determinant, unless
///    the primitive has no thickness: then it is an open surface.
/// 2. Where the end circles of round primitives start depends on the axis and the radius in the
///    placed frame only, never on the local frame: a pipe and the elbow or flange at its end meet
///    vertex to vertex (up to the snap).
/// 3. Triangles of one planar face share a face id; a curved side has one id per planar quad.
///
/// Definitions of the kinds: docs/formats/primitives.md.
///
/// For a view, `towards` points to the viewer in the placed frame; its length does not matter. The
/// silhouettes of round primitives in that direction then are edges of the mesh: on one side of
/// them facets face the viewer, on the other away. End circles start at the silhouette of their
/// pipe, so that 2. holds in each view too; where the pipe is along the direction, as above.
/// Silhouettes within a quarter of a step of each other or of an end circle are left out. A
/// silhouette replaces a regular vertex within a quarter of a step of it, so that chords may be a
/// quarter longer: `sag_mm` of the mesh includes that.
[[nodiscard]] Tessellation tessellate(const Primitive& primitive, const Mat3d& linear,
                                      double sag_mm,
                                      const std::optional<Vec3d>& towards = std::nullopt);

/// The same for a view in perspective: `eye` is a point of the placed frame, and the silhouettes of
/// cylinders, snouts, spheres, dishes and tori from there are edges of the mesh. There is none of a
/// cylinder, a sphere or a dish whose axis or ball's centre is nearer to the eye than 1.02 radii,
/// of a dish where it would hardly rise over the base, nor of a torus of which some section's
/// circle, in its own plane, is nearer than three tube radii to it. End
/// circles have as many chords on either side of the silhouette, so that those on the far side may
/// be 1.25 times as long; `sag_mm` of the mesh includes that.
[[nodiscard]] Tessellation tessellate_from(const Vec3d& eye, const Primitive& primitive,
                                           const Mat3d& linear, double sag_mm);

}  // namespace strake::geometry
