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

/// What is asked: whether a point of both parts is farther from the skin of the first than `level`.
struct LevelQuery {
  double level = 0;
  double known = 0;    ///< such a depth is known; less than the level
  double ceiling = 0;  ///< none is greater
  double slack = 0;    ///< how far a point of the field grid may be off, distances' errors included
  std::span<const HalfSpace> hull_of = {}, hull_in = {};  ///< hold either part; unit normals
  std::uint64_t most_cells = 0;  ///< work limit, beyond the pieces that the surfaces come in
};

struct LevelResult {
  bool none = false;            ///< certainly no point is
  bool too_large = false;       ///< the surfaces have too many triangles; a deeper one has no fewer
  std::optional<Vec3d> deeper;  ///< a point of both that is deeper than what is known
  std::uint64_t cells = 0;      ///< that pieces and cells were cut into, and searches as long
};

/// Half-spaces that hold a part, relative to the common origin: those of its support planes, or a
/// share of them that looks to all sides.
[[nodiscard]] std::vector<HalfSpace> half_spaces_of(const DistanceField& part);

/// If x is deeper in the first part than the level, the straight way from x to the nearest point of
/// its skin leads to a point at the level, which is on the surface parallel to the skin. Either the
/// way crosses the skin of the second part at the level or deeper, or that point is in the second.
/// So only surfaces are searched: the skin of the second for points in the first that are as deep,
/// and the parallel surface (triangles moved inwards, round edges and corners that stand in) for
/// points in both that are no nearer to another triangle.
[[nodiscard]] LevelResult search_above_level(const DistanceField& of, const DistanceField& in,
                                             const LevelQuery& question, const DepthOptions& goal,
                                             QueryContext& work);

}  // namespace strake::geometry
