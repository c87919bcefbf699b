// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/interior_depth/level_search/offset_cell.hpp"
#include "geometry/interior_depth/surface_distance/distance_field.hpp"

namespace strake::geometry {

/// The region in which a surface is needed: a box and half-spaces with unit normals.
struct SearchRegion {
  const Box3d& box;
  std::span<const HalfSpace> hull;
};

/// Returns cells that cover all points of a part at some distance from its surface in a region: its
/// triangles moved inwards, and rounded reflex edges and vertices; on both sides and all round
/// where the part overlaps itself. Cells that bend by less than `flat` grid units are left out:
/// they are that near to the rest. Nothing where there are too many cells.
[[nodiscard]] std::optional<std::vector<OffsetCell>> offset_surface(const DistanceField& of,
                                                                    const SearchRegion& region,
                                                                    double distance, double flat,
                                                                    QueryContext& work);

/// Returns the triangles whose boxes come within a distance of a box; nothing where these are too
/// many.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> triangles_near(const DistanceField& of,
                                                                       const Box3d& box,
                                                                       double distance);

}  // namespace strake::geometry
