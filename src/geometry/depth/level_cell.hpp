// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/corners.hpp"

namespace strake::geometry {

/// normal·x <= offset.
struct HalfSpace {
  Vec3d normal;
  double offset = 0;
};

/// A piece of a skin, or of the surface that runs parallel to one, on its inner side: all of it is
/// within `slack` of the convex hull of its corners, which lie in one plane or nearly so.
struct LevelCell {
  std::vector<Vec3d> corners;  ///< in order round it
  /// Of a curved piece, that runs round an edge or corner of the skin: the point of that for each
  /// corner.
  std::vector<Vec3d> about;
  double slack = 0;
  bool on_skin = false;  ///< of the part that is looked for points in
};

/// The mean of the corners.
[[nodiscard]] Vec3d middle_of(const LevelCell& cell);
/// No corner is farther from a point.
[[nodiscard]] double radius_of(const LevelCell& cell, const Vec3d& from);

/// Of a triangle moved by `way`.
[[nodiscard]] LevelCell flat_cell(const Corners& triangle, const Vec3d& way);

/// Points at a distance from an edge, from one direction to another, unit vectors square to it and
/// no farther from each other than a quarter turn.
[[nodiscard]] LevelCell round_edge(const std::array<Vec3d, 2>& edge,
                                   const std::array<Vec3d, 2>& ways, double distance);

/// Points at a distance from a corner in the directions between three.
[[nodiscard]] LevelCell round_corner(const Vec3d& corner, const std::array<Vec3d, 3>& ways,
                                     double distance);

/// Two cells that hold all of a cell: a flat one is cut across, a curved one where it bends.
[[nodiscard]] std::array<LevelCell, 2> halves_of(const LevelCell& cell);

/// What of a flat cell is in a half-space; no corners where that is none.
[[nodiscard]] LevelCell part_in(const LevelCell& cell, const HalfSpace& space);

/// Whether a triangle certainly stays farther from the hull of a cell, or a segment, than `by`.
[[nodiscard]] bool are_apart(std::span<const Vec3d> cell, const Corners& triangle, double by);

}  // namespace strake::geometry
