// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/interior_depth/level_search/offset_cell.hpp"
#include "geometry/interior_depth/surface_distance/distance_field.hpp"

namespace strake::geometry {

/// Where a surface is asked for: a box and half-spaces with unit normals.
struct SearchRegion {
  const Box3d& box;
  std::span<const HalfSpace> hull;
};

/// All points of a part at some distance from its skin that lie in a room, or more: its triangles
/// moved inwards, and round edges and corners that stand in; to both sides and all round where the
/// part overlaps itself. What bends by less than `flat` grid units there is left out: it is so near
/// to what is not. Nothing where there is too much of it.
[[nodiscard]] std::optional<std::vector<OffsetCell>> offset_surface(const DistanceField& of,
                                                                    const SearchRegion& room,
                                                                    double distance, double flat,
                                                                    QueryContext& work);

/// The triangles whose boxes come within a distance of a box; nothing where these are too many.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> triangles_near(const DistanceField& of,
                                                                       const Box3d& box,
                                                                       double distance);

}  // namespace strake::geometry
