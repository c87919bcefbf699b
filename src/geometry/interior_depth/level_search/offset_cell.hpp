// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/interior_depth/surface_distance/distance_field.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {

/// normal·x <= offset.
struct HalfSpace {
  Vec3d normal;
  double offset = 0;
};

/// A piece of a skin, or of the surface that runs parallel to one, on its inner side: all of it is
/// within `slack` of the convex hull of its corners, which lie in one plane or nearly so.
struct OffsetCell {
  std::vector<Vec3d> corners;  ///< in order round it
  /// Of a curved piece, that runs round an edge or corner of the skin: the point of that for each
  /// corner.
  std::vector<Vec3d> about;
  double slack = 0;
  bool on_skin = false;  ///< of the part that is looked for points in
};

/// The mean of the corners.
[[nodiscard]] Vec3d middle_of(const OffsetCell& cell);
/// No corner is farther from a point.
[[nodiscard]] double radius_of(const OffsetCell& cell, const Vec3d& from);

/// Of a triangle moved by `way`.
[[nodiscard]] OffsetCell flat_cell(const Corners& triangle, const Vec3d& way);

/// Points at a distance from an edge, from one direction to another, unit vectors square to it and
/// no farther from each other than a quarter turn.
[[nodiscard]] OffsetCell round_edge(const std::array<Vec3d, 2>& edge,
                                    const std::array<Vec3d, 2>& ways, double distance);

/// Points at a distance from a corner in the directions between three.
[[nodiscard]] OffsetCell round_corner(const Vec3d& corner, const std::array<Vec3d, 3>& ways,
                                      double distance);

/// Two cells that hold all of a cell: a flat one is cut across, a curved one where it bends.
[[nodiscard]] std::array<OffsetCell, 2> halves_of(const OffsetCell& cell);

/// What of a flat cell is in a half-space; no corners where that is none.
[[nodiscard]] OffsetCell clip_to(const OffsetCell& cell, const HalfSpace& space);

/// Whether a triangle certainly stays farther from the hull of a cell, or a segment, than `by`.
[[nodiscard]] bool is_cell_apart(std::span<const Vec3d> cell, const Corners& triangle, double by);

/// A cell as triangles are held against it: the hull of its corners and all that is within its
/// slack.
class CellHull {
 public:
  /// Keeps a reference to the cell.
  CellHull(const OffsetCell& cell, double slack);

  [[nodiscard]] std::span<const Vec3d> corners() const { return cell_.corners; }
  [[nodiscard]] double slack() const { return slack_; }
  [[nodiscard]] const Box3d& box() const { return box_; }
  /// Whether a triangle certainly stays out of it, as far as boxes and the planes of both tell.
  [[nodiscard]] bool is_clearly_apart(const PreparedTriangle& triangle) const;
  /// As far as anything tells.
  [[nodiscard]] bool is_apart(const PreparedTriangle& triangle) const {
    return !goes_through(triangle) && is_cell_apart(cell_.corners, triangle.corners, slack_);
  }

 private:
  /// Whether a triangle and the hull of the corners have points in common, but for rounding, where
  /// each goes through the plane of the other: the chords along the line of both.
  [[nodiscard]] bool goes_through(const PreparedTriangle& triangle) const;

  const OffsetCell& cell_;
  double slack_ = 0;
  Box3d box_;
  Vec3d up_;  ///< unit normal of the first three corners; none where they are in line
  ProjectionInterval along_up_;
};

/// Triangles beyond which a cell is only halved.
inline constexpr std::size_t kMaxCrossing = 24;

/// Whether all of a cell is certainly outside a part. `middle`: a point of it, on the field grid.
[[nodiscard]] bool is_outside(const DistanceField& field, const CellHull& cell, const Vec3d& middle,
                              QueryContext& work);

/// Which triangles of a part may meet a cell and the cells that it is cut into: each is held only
/// against those that may meet the cell it comes from. Cells are looked at depth first.
class CellCuller {
 public:
  explicit CellCuller(const DistanceField& field) : field_(field) {}

  /// Of all points of a cell: `both` where some triangle may meet it.
  enum class CellSide : std::uint8_t { both, inside, outside };

  /// What is known about a cell, and about all that it is cut into; at first nothing.
  struct CellStatus {
    std::uint32_t first = 0, last = 0;  ///< of the triangles that may meet it
    bool known = false;
    CellSide side = CellSide::both;
  };

  /// `from`: what is known about the cell that this one is cut from. The triangles that may meet it
  /// are added to `crossing`, as long as these are no more than kMaxCrossing. `middle`: a point of
  /// the cell, on the field grid.
  [[nodiscard]] CellStatus classify(const CellHull& cell, const CellStatus& from,
                                    const Vec3d& middle, std::vector<Corners>& crossing,
                                    QueryContext& work);

 private:
  /// The triangles whose boxes meet that of a cell: how many.
  std::uint32_t read(const CellHull& cell);

  const DistanceField& field_;
  std::vector<PreparedTriangle> triangles_;  ///< of the whole cell; relative to the common origin
  std::vector<std::uint32_t> list_;          ///< of triangles_, for each open cell its own
};

}  // namespace strake::geometry
