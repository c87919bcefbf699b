// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "strake/geometry/mesh.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A mesh under the linear part of a placement, on the grid: the position of a vertex is base +
/// vertex = snap(linear · local).
struct SnappedMesh {
  GridMesh mesh;
  Vec3l base;  ///< the middle of its box
  std::uint64_t bad_triangles =
      0;  ///< left out: an index out of range, or a vertex beyond the grid
};

/// Snaps every vertex that a triangle uses. A mirroring map flips the winding.
/// Nothing when the result is wider than 2^31 grid units (2.1 km).
[[nodiscard]] std::optional<SnappedMesh> snap_to_grid(const TriangleMesh& mesh,
                                                      const Mat3d& linear);

/// Snaps meshes one after another in memory that it keeps: one per worker.
class GridSnapper {
 public:
  /// Returns snap_to_grid() of a mesh, null for nothing; valid until the next call.
  [[nodiscard]] const SnappedMesh* snap_to_grid(const TriangleMesh& mesh, const Mat3d& linear);

 private:
  friend std::optional<SnappedMesh> geometry::snap_to_grid(const TriangleMesh& mesh,
                                                           const Mat3d& linear);
  void take_triangles(const TriangleMesh& mesh, bool mirrored);
  [[nodiscard]] bool take_vertices();

  std::vector<Vec3l> snapped_;
  std::vector<std::uint8_t> used_;         ///< of `snapped_`
  std::vector<std::uint32_t> renumbered_;  ///< likewise, where some are not used
  SnappedMesh placed_;
};

/// Chains on the grid as a wire part; `bad_points` counts points left out because they lie beyond
/// the grid.
struct SnappedWire {
  Part part;
  Vec3l base;
  std::uint64_t bad_points = 0;
};

/// Consecutive equal points become one; chains of fewer than two points are dropped.
[[nodiscard]] std::optional<SnappedWire> snap_to_grid(const Polylines& lines, const Mat3d& linear);

/// Returns the largest factor by which a map lengthens a vector, rounded up by less than one part
/// in 10^9 for similarities (an upper bound for others).
[[nodiscard]] double largest_scale(const Mat3d& linear);

}  // namespace strake::geometry
