// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "strake/geometry/predicates.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A non-degenerate triangle with its plane, prepared for many exact tests. Edge i runs from
/// corner i to corner i + 1 (mod 3).
struct ExactTriangle {
  std::array<Vec3l, 3> corner;
  ExactPlane plane;

  constexpr explicit ExactTriangle(const std::array<Vec3l, 3>& corners)
      : corner(corners), plane(corners[0], corners[1], corners[2]) {}
};

/// Sides of a triangle's corners with respect to a plane, each -1, 0 or 1.
using CornerSides = std::array<int, 3>;

[[nodiscard]] constexpr CornerSides sides_of(const ExactTriangle& t, const ExactPlane& plane) {
  return {plane.side(t.corner[0]), plane.side(t.corner[1]), plane.side(t.corner[2])};
}

enum class Touch : std::uint8_t {
  none,
  point,    ///< one common point
  segment,  ///< a common segment of positive length
  area,     ///< coplanar, with a common area
};

/// The intersection of two closed triangles, decided exactly.
struct TriangleContact {
  Touch touch = Touch::none;
  bool coplanar = false;
  bool same_normal = false;  ///< coplanar only: the normals point the same way
  CornerSides side_a{};      ///< corners of a against the plane of b
  CornerSides side_b{};      ///< corners of b against the plane of a
  /// Not coplanar, segment: the edge in whose line the segment lies; -1 where it runs through the
  /// interior.
  int edge_a = -1, edge_b = -1;
  /// Coplanar: bit i set when edge i shares a segment with the other's open interior.
  unsigned edges_of_a_inside_b = 0, edges_of_b_inside_a = 0;
  /// Coplanar: bit 3·i + j set when edge i of a and edge j of b share a segment.
  unsigned shared_edges = 0;
};

/// Returns the intersection of two triangles; exact for coordinates whose differences are at most
/// 2^31.
[[nodiscard]] TriangleContact contact(const ExactTriangle& a, const ExactTriangle& b);

/// Where an edge of a triangle meets the plane of another. Its two ends lie on opposite sides of
/// that plane, or one of them in it.
struct EdgeAtPlane {
  bool of_b = false;  ///< an edge of b at the plane of a
  int from = 0, to = 0;
};

/// Returns the two ends of the common segment of triangles in different planes; its direction is
/// (normal of a) x (normal of b).
[[nodiscard]] std::array<EdgeAtPlane, 2> segment_ends(const ExactTriangle& a,
                                                      const ExactTriangle& b,
                                                      const TriangleContact& c);

/// Returns a point common to both closed triangles, rounded to double; `c` is their contact, not
/// `none`.
[[nodiscard]] Vec3d common_point(const ExactTriangle& a, const ExactTriangle& b,
                                 const TriangleContact& c);

}  // namespace strake::geometry
