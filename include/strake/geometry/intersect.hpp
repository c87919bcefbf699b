// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/rational.hpp"
#include "strake/geometry/triangle_contact.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// The interval of a segment, ray or line that lies in a shape: parameters from `first` to `last`,
/// where 0 is the line's first point and 1 its second; they are infinite where it does not end.
struct LineStretch {
  Touch touch = Touch::none;  ///< none, point or segment (also of infinite length)
  Rational first, last;       ///< equal for a point
};

/// Intersections of a segment, ray or line with a plane, a triangle, a box or another line:
///
///     const LineInTriangle hit = intersect(GridLine{eye, target, LineKind::ray}, triangle);
///     if (hit.at.touch == Touch::point && hit.feature_first == 7) ...   // through the interior
///     const Vec3d p = point_at(line, hit.at.first).value();
///
/// 1. The class of a result is exact in the range of grid_shapes.hpp: coplanar, through an edge,
///    through a corner, an end that just touches. Parameters and points are exact rationals.
/// 2. Shapes are closed: a touch counts. A line whose two points are one is that point, with
///    parameter 0.
/// 3. A triangle or plane whose corners span no area is an error of the caller (asserted).
///
/// Pure; no allocation; well below a microsecond.
///
/// Parameters are the zeros of the shapes' boundary functions, which are linear along a line (M.
/// Cyrus and J. Beck, 1978); a triangle is met where its edges turn the same way round the line
/// (A. Segura and F. Feito, 2001).

/// `at.touch` is segment when all of the line lies in the plane.
struct LineInPlane {
  LineStretch at;
  int side_from = 0, side_to = 0;  ///< of the line's two points: 1 where the plane's normal points
};

/// Intersects a line with the plane through three points, whose normal is (b-a) x (c-a).
[[nodiscard]] LineInPlane intersect_plane(const GridLine& line, const TriangleCorners& plane);

struct LineInTriangle {
  LineStretch at;
  bool coplanar = false;           ///< the line lies in the triangle's plane
  int side_from = 0, side_to = 0;  ///< of the line's two points, against the triangle's plane
  /// The features of the triangle at the interval's ends.
  FeatureMask feature_first = 0, feature_last = 0;
};
[[nodiscard]] LineInTriangle intersect(const GridLine& line, const TriangleCorners& triangle);

struct LineInBox {
  LineStretch at;
  bool through_inside = false;  ///< part of the line lies in the open box: more than a touch
  /// The features of the box at the interval's ends.
  BoxFeatureMask feature_first = 0, feature_last = 0;
};
/// Intersects a line with a closed solid box that is not empty; the box may be flat.
[[nodiscard]] LineInBox intersect(const GridLine& line, const Box3l& box);

struct LineMeeting {
  Touch touch = Touch::none;
  bool coplanar = false;  ///< the two lines, each without its ends, lie in one plane
  bool parallel = false;  ///< their directions are equal or opposite, or one of them is a point
  /// The common interval as parameters of either line: first <= last on a; on b it runs from
  /// `first_b` to `last_b`, which may descend.
  Rational first_a, last_a, first_b, last_b;
};
[[nodiscard]] LineMeeting intersect(const GridLine& a, const GridLine& b);

/// Returns the exact point at a finite parameter.
[[nodiscard]] RationalPoint point_at(const GridLine& line, const Rational& parameter);

/// Returns point_at(...).rounded(), computed mostly in doubles.
[[nodiscard]] Vec3l rounded_at(const GridLine& line, const Rational& parameter);

}  // namespace strake::geometry
