// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0037 says why points go uphill before surfaces are searched.

#include <optional>
#include <span>

#include "geometry/interior_depth/surface_distance/distance_field.hpp"

namespace strake::geometry {

/// Returns a local maximum of the distance to the first part's surface, climbing from a point of
/// both parts without leaving the second or the box that counts; points are relative to the common
/// origin. Round any point, the distance to a triangle is at least that to the plane through its
/// nearest point: a linear program over all triangles within reach finds the next point, no less
/// deep than the program's bound and on the same side of every triangle.
[[nodiscard]] Vec3d local_depth_maximum(const DistanceField& of, const DistanceField& in,
                                        const Vec3d& from, const std::optional<Box3d>& within);

/// Returns the same for a point that must not leave a triangle, or a segment of two corners.
[[nodiscard]] Vec3d local_depth_maximum_on(const DistanceField& of, std::span<const Vec3d> corners,
                                           const Vec3d& from, const std::optional<Box3d>& within);

}  // namespace strake::geometry
