// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "geometry/depth/depth_field.hpp"

namespace strake::geometry {

/// What is known of a part at a point of the field grid.
struct FieldSample {
  double distance = 0;  ///< to the skin
  std::uint32_t triangle = kNoFace;
  bool inside = false;
};

/// A corner of a simplex: where it stands, and what both parts are at the nearest point of the
/// field grid.
struct SimplexCorner {
  Vec3d at;
  Vec3d sampled;
  FieldSample a, b;
};

/// A tetrahedron of space that a search looks for deep points in.
struct Simplex {
  std::array<SimplexCorner, 4> corner;
};

/// A certain bound on the depth in one part within a simplex, and the point it stems from.
struct SimplexBound {
  double upper = 0;
  Vec3d point;
};

/// How deep in a, and how deep in b, a point of a simplex can be that lies in both; nothing when
/// no point does. Bounds are not improved once they are no more than `enough`.
///
/// On a simplex the distance to one triangle is convex, so that the linear function through its
/// values at the corners is above it; the least of several such functions is greatest where a
/// small linear program says. Where the simplex sticks out of a part through a flat or convex piece
/// of its skin, the planes of that piece cut off what is outside; and where the whole shadow of the
/// simplex falls on a flat piece, depth is the height below it. On polyhedra all of that is linear:
/// a simplex that sees no more than one reflex edge is bounded exactly.
///
/// `slack`: how far a sampled point may lie from its corner, distances' errors included.
[[nodiscard]] std::optional<std::array<SimplexBound, 2>> bound_depth(const DepthField& a,
                                                                     const DepthField& b,
                                                                     const Simplex& s, double slack,
                                                                     double enough, PairWork& work);

}  // namespace strake::geometry
