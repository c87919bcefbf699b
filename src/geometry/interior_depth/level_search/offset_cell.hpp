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

/// The half-space normal·x <= offset.
struct HalfSpace {
  Vec3d normal;
  double offset = 0;
};

/// A piece of a surface, or of its offset surface on the inner side: all of it is within `slack` of
/// the convex hull of its corners, which lie in one plane or nearly so.
struct OffsetCell {
  std::vector<Vec3d> corners;  ///< in order round the cell
  /// For each corner of a curved cell, which runs round an edge or vertex of the surface: the point
  /// of that edge or vertex.
  std::vector<Vec3d> about;
  double slack = 0;
  bool on_surface = false;  ///< of the part that is searched for points
};

/// Returns the mean of the corners.
[[nodiscard]] Vec3d middle_of(const OffsetCell& cell);
/// Returns the greatest distance of a corner from a point.
[[nodiscard]] double radius_of(const OffsetCell& cell, const Vec3d& from);

/// Returns the cell of a triangle moved by `way`.
[[nodiscard]] OffsetCell flat_cell(const Corners& triangle, const Vec3d& way);

/// Returns the cell of points at a distance from an edge, from one direction to another, which are
/// unit vectors perpendicular to it and at most a quarter circle apart.
[[nodiscard]] OffsetCell round_edge(const std::array<Vec3d, 2>& edge,
                                    const std::array<Vec3d, 2>& ways, double distance);

/// Returns the cell of points at a distance from a vertex in the directions between three.
[[nodiscard]] OffsetCell round_corner(const Vec3d& corner, const std::array<Vec3d, 3>& ways,
                                      double distance);

/// Returns two cells that cover a cell: a flat one is split across, a curved one where it bends.
[[nodiscard]] std::array<OffsetCell, 2> halves_of(const OffsetCell& cell);

/// Returns the part of a flat cell in a half-space; without corners where that is empty.
[[nodiscard]] OffsetCell clip_to(const OffsetCell& cell, const HalfSpace& space);

/// Whether a triangle certainly stays farther from the hull of a cell, or a segment, than `by`.
[[nodiscard]] bool is_cell_apart(std::span<const Vec3d> cell, const Corners& triangle, double by);

/// The hull of a cell's corners grown by its slack, for tests against triangles.
class CellHull {
 public:
  /// Makes the hull; it keeps a reference to the cell.
  CellHull(const OffsetCell& cell, double slack);

  [[nodiscard]] std::span<const Vec3d> corners() const { return cell_.corners; }
  [[nodiscard]] double slack() const { return slack_; }
  [[nodiscard]] const Box3d& box() const { return box_; }
  /// Whether boxes and the planes of both show that a triangle stays out of the hull.
  [[nodiscard]] bool is_clearly_apart(const PreparedTriangle& triangle) const;
  /// Whether any test shows that a triangle stays out of the hull.
  [[nodiscard]] bool is_apart(const PreparedTriangle& triangle) const {
    return !goes_through(triangle) && is_cell_apart(cell_.corners, triangle.corners, slack_);
  }

 private:
  /// Whether a triangle and the hull of the corners have points in common, but for rounding, where
  /// each crosses the plane of the other: by their chords along the line of both planes.
  [[nodiscard]] bool goes_through(const PreparedTriangle& triangle) const;

  const OffsetCell& cell_;
  double slack_ = 0;
  Box3d box_;
  Vec3d up_;  ///< unit normal of the first three corners; none where they are in line
  ProjectionInterval along_up_;
};

/// Maximum number of triangles that a cell is tested against; beyond it the cell is only halved.
inline constexpr std::size_t kMaxCrossing = 24;

/// Whether a cell is certainly all outside a part. `middle`: a point of the cell, on the field
/// grid.
[[nodiscard]] bool is_outside(const DistanceField& field, const CellHull& cell, const Vec3d& middle,
                              QueryContext& work);

/// Finds the triangles of a part that may meet a cell and the cells that it is split into: each is
/// tested only against those that may meet its parent. Cells are visited depth first.
class CellCuller {
 public:
  explicit CellCuller(const DistanceField& field) : field_(field) {}

  /// The side of all points of a cell: `both` where some triangle may meet it.
  enum class CellSide : std::uint8_t { both, inside, outside };

  /// What is known about a cell and all its descendants; at first nothing.
  struct CellStatus {
    std::uint32_t first = 0, last = 0;  ///< of the triangles that may meet it
    bool known = false;
    CellSide side = CellSide::both;
  };

  /// Classifies a cell. `from`: what is known about its parent. The triangles that may meet it are
  /// added to `crossing`, as long as these are no more than kMaxCrossing. `middle`: a point of the
  /// cell, on the field grid.
  [[nodiscard]] CellStatus classify(const CellHull& cell, const CellStatus& from,
                                    const Vec3d& middle, std::vector<Corners>& crossing,
                                    QueryContext& work);

 private:
  /// Collects the triangles whose boxes meet that of a cell, and returns their number.
  std::uint32_t read(const CellHull& cell);

  const DistanceField& field_;
  std::vector<PreparedTriangle> triangles_;  ///< of the whole cell; relative to the common origin
  std::vector<std::uint32_t> list_;          ///< of triangles_, for each open cell its own
};

}  // namespace strake::geometry
