// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  bool convex = false;     ///< before the snap
  std::string_view fault;  ///< why there is nothing: "not finite", "no extent" …; empty when fine
};

/// Triangulates a primitive under the linear part of its placement, so that no triangle lies
/// farther than `sag_mm` from the true surface and the reverse, both measured after the map.
///
/// 1. The mesh is closed and oriented outward whatever the sign of the map's determinant, unless
///    the primitive has no thickness: then it is a surface.
/// 2. Where the rims of round primitives start depends on the axis and the radius in the placed
///    frame only, never on the local frame: a pipe and the elbow or flange at its end meet vertex
///    to vertex (up to the snap).
/// 3. Triangles of one planar face share a face id; a curved side has one id per planar quad.
///
/// Definitions of the kinds: docs/formats/primitives.md.
[[nodiscard]] Tessellation tessellate(const Primitive& primitive, const Mat3d& linear,
                                      double sag_mm);

}  // namespace strake::geometry
