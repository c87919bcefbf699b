// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/depth/depth_field.hpp"
#include "geometry/depth/level_cell.hpp"

namespace strake::geometry {

/// A cell as triangles are held against it: the hull of its corners and all that is within its
/// slack.
class CellHull {
 public:
  /// Keeps a reference to the cell.
  CellHull(const LevelCell& cell, double slack);

  [[nodiscard]] std::span<const Vec3d> corners() const { return cell_.corners; }
  [[nodiscard]] double slack() const { return slack_; }
  [[nodiscard]] const Box3d& box() const { return box_; }
  /// Whether a triangle certainly stays out of it, as far as boxes and the planes of both tell.
  [[nodiscard]] bool is_clearly_apart(const PreparedTriangle& triangle) const;
  /// As far as anything tells.
  [[nodiscard]] bool is_apart(const PreparedTriangle& triangle) const {
    return !goes_through(triangle) && are_apart(cell_.corners, triangle.corners, slack_);
  }

 private:
  /// Whether a triangle and the hull of the corners have points in common, but for rounding, where
  /// each goes through the plane of the other: the chords along the line of both.
  [[nodiscard]] bool goes_through(const PreparedTriangle& triangle) const;

  const LevelCell& cell_;
  double slack_ = 0;
  Box3d box_;
  Vec3d up_;  ///< unit normal of the first three corners; none where they are in line
  Range along_up_;
};

/// Triangles beyond which a cell is only halved.
inline constexpr std::size_t kMostCrossing = 24;

/// Whether all of a cell is certainly outside a part. `middle`: a point of it, on the field grid.
[[nodiscard]] bool is_outside(const DepthField& field, const CellHull& cell, const Vec3d& middle,
                              PairWork& work);

/// Which triangles of a part may meet a cell and the cells that it is cut into: each is held only
/// against those that may meet the cell it comes from. Cells are looked at depth first.
class PartScope {
 public:
  explicit PartScope(const DepthField& field) : field_(field) {}

  /// Of all points of a cell: `both` where some triangle may meet it.
  enum class Side : std::uint8_t { both, inside, outside };

  /// What is known about a cell, and about all that it is cut into; at first nothing.
  struct About {
    std::uint32_t first = 0, last = 0;  ///< of the triangles that may meet it
    bool known = false;
    Side side = Side::both;
  };

  /// `from`: what is known about the cell that this one is cut from. The triangles that may meet it
  /// are added to `crossing`, as long as these are no more than kMostCrossing. `middle`: a point of
  /// the cell, on the field grid.
  [[nodiscard]] About look(const CellHull& cell, const About& from, const Vec3d& middle,
                           std::vector<Corners>& crossing, PairWork& work);

 private:
  /// The triangles whose boxes meet that of a cell: how many.
  std::uint32_t read(const CellHull& cell);

  const DepthField& field_;
  std::vector<PreparedTriangle> triangles_;  ///< of the whole cell; relative to the common origin
  std::vector<std::uint32_t> list_;          ///< of triangles_, for each open cell its own
};

}  // namespace strake::geometry
