// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0055 says why only surfaces are searched.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/interior_depth/level_search/offset_cell.hpp"
#include "geometry/interior_depth/surface_distance/distance_field.hpp"

namespace strake::geometry {

/// The query whether a point of both parts is farther from the first part's surface than `level`.
struct LevelQuery {
  double level = 0;
  double known = 0;    ///< depth already known; less than the level
  double ceiling = 0;  ///< upper bound of all depths
  double slack = 0;    ///< how far a point of the field grid may be off, distances' errors included
  std::span<const HalfSpace> hull_of = {},
                             hull_in = {};  ///< they contain either part; unit normals
  std::uint64_t max_cells = 0;  ///< work limit, beyond the cells that the surfaces consist of
};

struct LevelResult {
  bool none = false;            ///< certainly no point is deeper than the level
  bool too_large = false;       ///< the surfaces have too many triangles, also at deeper levels
  std::optional<Vec3d> deeper;  ///< a point of both that is deeper than `known`
  std::uint64_t cells = 0;      ///< cells visited, and searches that cost as much
};

/// Returns half-spaces that contain a part, relative to the common origin: those of its FaceKdop,
/// or a share of them that faces all directions.
[[nodiscard]] std::vector<HalfSpace> half_spaces_of(const DistanceField& part);

/// Searches for a point deeper than the level. If x is deeper in the first part than the level, the
/// segment from x to the nearest point of its surface passes a point at the level, on the offset
/// surface. Either the segment crosses the second part's surface at the level or deeper, or that
/// point is in the second part. So only surfaces are searched: the second part's for points in the
/// first that are as deep, and the offset surface (triangles moved inwards, rounded reflex edges
/// and vertices) for points in both that are no nearer to another triangle.
[[nodiscard]] LevelResult search_above_level(const DistanceField& of, const DistanceField& in,
                                             const LevelQuery& query, const DepthOptions& goal,
                                             QueryContext& work);

}  // namespace strake::geometry
