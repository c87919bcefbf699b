// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/mesh.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {

enum class Separation : std::uint8_t {
  apart,       ///< no common point: a plane square to the axis parts them
  touching,    ///< common points, but there are moves as short as you like that part them
  overlapping  ///< common points, and still so after any move that is short enough
};

/// The separating axis of two convex shapes.
struct SeparatingAxis {
  Separation separation = Separation::apart;
  /// From a to b, reduced to lowest terms; never zero.
  Vec3<Int128> axis;
  /// How far apart the two lie along the axis, times the axis's length; negative: how far they
  /// overlap.
  Int128 gap = 0;

  /// The same in grid units, rounded: gap / |axis|. Apart, a lower bound of the distance; otherwise
  /// minus the least way that b must move (along the axis) to come off a.
  [[nodiscard]] double width() const;
};

/// A box whose edges need not follow the axes, nor be square to each other (which no rotated box is
/// on a grid): corner, corner + edge 0, .. Edges may vanish or lie in one plane.
struct GridBox {
  Vec3l corner;
  std::array<Vec3l, 3> edge;
};

/// A convex body by its surface. What the triangles span must be convex (not checked): a closed
/// body outward or not, a flat polygon in pieces. Without triangles: the segment between the first
/// two points, or the first point. Points that no triangle uses count as part of the body.
struct ConvexSurface {
  std::span<const Vec3l> points;
  std::span<const Triangle> triangles;
};

/// Whether two convex shapes have a point or an interior in common, with the axis that shows it.
///
///     const SeparatingAxis s = separating_axis(box, other);
///     if (s.separation == Separation::apart) log(s.axis, s.width());
///
/// 1. Exact in the range of grid_shapes.hpp, the class and the axis alike.
/// 2. The axis is the widest of the candidates: face normals of either, products of an edge of a
///    and one of b (S. Gottschalk, M. Lin and D. Manocha, OBBTree, 1996), and, where all these
///    share one direction, the normals of the edges in a view of that plane. Of overlapping shapes
///    it is the way of the least move that parts them.
/// 3. Among equally wide axes the lexicographically greatest, up to sign, counts: swapped shapes
///    have the same axis the other way round, unless both ways are equally wide; then it is the
///    lexicographically positive one.
/// 4. Two bodies overlap when their insides have points in common; a flat shape that passes through
///    another, flat or not, overlaps it; two in one plane never do more than touch.
///
/// Pure. O(edges² · points) for bodies; some microseconds for boxes and triangles.
[[nodiscard]] SeparatingAxis separating_axis(const TriangleCorners& a, const TriangleCorners& b);
[[nodiscard]] SeparatingAxis separating_axis(const Box3l& a, const Box3l& b);
[[nodiscard]] SeparatingAxis separating_axis(const GridBox& a, const GridBox& b);
[[nodiscard]] SeparatingAxis separating_axis(const ConvexSurface& a, const ConvexSurface& b);

}  // namespace strake::geometry
