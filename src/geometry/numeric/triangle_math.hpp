// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {

// Corners and edges of a triangle by their numbers, 0 to 2: edge i runs from corner i to the next.

template <std::integral Corner>
[[nodiscard]] constexpr Corner next_corner(Corner i) {
  return i == 2 ? Corner{0} : static_cast<Corner>(i + 1);
}
[[nodiscard]] constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A triangle given by its corners in doubles.
using Corners = std::array<Vec3d, 3>;

/// Returns a triangle in the part's own coordinates.
[[nodiscard]] inline Corners corners_of(const Part& part, const Triangle& t) {
  return {part.vertices[t[0]].as<double>(), part.vertices[t[1]].as<double>(),
          part.vertices[t[2]].as<double>()};
}
[[nodiscard]] inline Corners corners_of(const Part& part, std::uint32_t triangle) {
  return corners_of(part, part.triangles[triangle]);
}

[[nodiscard]] inline Corners as_doubles(const TriangleCorners& t) {
  return {t[0].as<double>(), t[1].as<double>(), t[2].as<double>()};
}

/// Returns a normal whose length is twice the area.
[[nodiscard]] inline Vec3d normal_of(const Corners& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// Returns the longest edge of a triangle; of equal ones the first.
[[nodiscard]] inline Vec3d longest_edge(const Corners& t) {
  Vec3d longest = t[1] - t[0];
  for (const Vec3d& edge : {t[2] - t[1], t[0] - t[2]})
    if (dot(edge, edge) > dot(longest, longest)) longest = edge;
  return longest;
}

/// Whether the projection of a point along the normal lies in the triangle; in double arithmetic.
[[nodiscard]] inline bool projects_inside(const Vec3d& p, const Corners& t, const Vec3d& normal) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!(dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) >= 0)) return false;
  return true;
}

/// Returns the angle, in radians, by which snapping its corners may have rotated a triangle with
/// this normal (not a unit one): two grid units in its width. The normals of slivers of one flat
/// face scatter.
[[nodiscard]] inline double snap_angle_error(const Corners& t, const Vec3d& normal) {
  constexpr double kUnits = 2;
  return kUnits * length(longest_edge(t)) / length(normal);
}

/// Whether two unit normals, each rotated by up to its tilt, may be those of one flat face.
[[nodiscard]] inline bool may_be_one_face(const Vec3d& n, double tilt_n, const Vec3d& m,
                                          double tilt_m) {
  const Vec3d apart = n - m;
  const double tilt = tilt_n + tilt_m;
  return dot(apart, apart) <= tilt * tilt;
}

/// Triangles that the snap may have rotated by more than this, in radians, may be slivers of one
/// flat face; the second constant is the least number of them that is worth special treatment.
inline constexpr double kSliverAngle = 1.0 / 16384;
inline constexpr std::size_t kFewestSlivers = 32;

}  // namespace strake::geometry
