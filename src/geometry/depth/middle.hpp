// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "geometry/depth/radius_lp.hpp"

namespace strake::geometry {

/// The way from the origin to the middle of a convex region that holds it: the point farthest from
/// the nearest boundaries; where these leave it free, as the sides of a bar do along the bar,
/// farthest from the next ones, and so on. The middle of a box or prism, whatever its lengths.
/// Weights of the constraints mean nothing; `extent` bounds the region. Where the origin breaks a
/// constraint, that is as if it were on its boundary.
[[nodiscard]] Vec3d way_to_middle(std::span<const RadiusConstraint> region, double extent);

}  // namespace strake::geometry
