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
  apart,       ///< no common point: a plane perpendicular to the axis separates them
  touching,    ///< common points, but arbitrarily short translations separate them
  overlapping  ///< common points, also after any short enough translation
};

/// The separating axis of two convex shapes.
struct SeparatingAxis {
  Separation separation = Separation::apart;
  /// Points from a to b, reduced to lowest terms; never zero.
  Vec3<Int128> axis;
  /// The gap of the two along the axis, times the axis's length; negative where they overlap by
  /// that much.
  Int128 gap = 0;

  /// Returns gap / |axis|, rounded, in grid units. Apart, it is a lower bound of the distance;
  /// otherwise minus the minimal translation (along the axis) that takes b off a.
  [[nodiscard]] double width() const;
};

/// A box whose edges need not be parallel to the axes, nor perpendicular to each other (those of a
/// rotated box on a grid are not): corner, corner + edge 0, .. Edges may vanish or lie in one
/// plane.
struct GridBox {
  Vec3l corner;
  std::array<Vec3l, 3> edge;
};

/// A convex body given by its surface. The triangles must span a convex set (not checked): a closed
/// body, oriented outward or not, or a flat polygon. Without triangles it is the segment between
/// the first two points, or the first point. Points that no triangle uses count as part of the
/// body.
struct ConvexSurface {
  std::span<const Vec3l> points;
  std::span<const Triangle> triangles;
};

/// Returns whether two convex shapes have a point or an interior in common, with the axis that
/// shows it.
///
///     const SeparatingAxis s = separating_axis(box, other);
///     if (s.separation == Separation::apart) log(s.axis, s.width());
///
/// 1. Exact in the range of grid_shapes.hpp, the class and the axis alike.
/// 2. The axis is the widest of the candidates: face normals of either, cross products of an edge
///    of a and one of b (S. Gottschalk, M. Lin and D. Manocha, OBBTree, 1996), and, where all these
///    share one direction, the normals of the edges within the plane perpendicular to it. Of
///    overlapping shapes it is the direction of the minimal translation that separates them.
/// 3. Among equally wide axes the lexicographically greatest, up to sign, counts: swapped shapes
///    have the opposite axis, unless both signs are equally wide; then it is the lexicographically
///    positive one.
/// 4. Two bodies overlap when their interiors have points in common; a flat shape that passes
///    through another, flat or not, overlaps it; two shapes in one plane at most touch.
///
/// Pure. O(edges² · points) for bodies; some microseconds for boxes and triangles.
[[nodiscard]] SeparatingAxis separating_axis(const TriangleCorners& a, const TriangleCorners& b);
[[nodiscard]] SeparatingAxis separating_axis(const Box3l& a, const Box3l& b);
[[nodiscard]] SeparatingAxis separating_axis(const GridBox& a, const GridBox& b);
[[nodiscard]] SeparatingAxis separating_axis(const ConvexSurface& a, const ConvexSurface& b);

}  // namespace strake::geometry
