// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "strake/geometry/grid_shapes.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// A triangle by its corners in doubles.
using Corners = std::array<Vec3d, 3>;

/// In the part's own coordinates.
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

/// Its length is twice the area.
[[nodiscard]] inline Vec3d normal_of(const Corners& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// The longest edge of a triangle; of equal ones the first, from the first corner on.
[[nodiscard]] inline Vec3d longest_edge(const Corners& t) {
  Vec3d longest = t[1] - t[0];
  for (const Vec3d& edge : {t[2] - t[1], t[0] - t[2]})
    if (dot(edge, edge) > dot(longest, longest)) longest = edge;
  return longest;
}

/// Whether a point lies in, over or under the triangle with this normal; in double arithmetic.
[[nodiscard]] inline bool stands_over(const Vec3d& p, const Corners& t, const Vec3d& normal) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!(dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) >= 0)) return false;
  return true;
}

}  // namespace strake::geometry
