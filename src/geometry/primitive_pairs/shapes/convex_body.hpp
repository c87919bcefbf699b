// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <variant>

#include "geometry/primitive_pairs/shapes/support_mapping.hpp"
#include "strake/geometry/primitive_separation.hpp"

namespace strake::geometry::primitive_pairs {

/// Returns a placed primitive as a convex set about `origin`, with every rounding on the way in
/// ConvexBody::error. Nothing for tori, for lines, for lengths that make no body, for a snout whose
/// end planes intersect inside it, and for maps that flatten.
[[nodiscard]] std::optional<ConvexBody> convex_body(const PlacedPrimitive& p, const Vec3l& origin);

/// Returns the triangle with these corners, or the box about a centre.
[[nodiscard]] ConvexBody triangle_body(const std::array<Vec3d, 3>& corners);
[[nodiscard]] ConvexBody block_body(const Vec3d& centre, const Vec3d& half);

/// Returns one point as a set.
[[nodiscard]] inline ConvexBody point_body(const Vec3d& p) { return block_body(p, {}); }

/// Returns the largest absolute coordinate.
[[nodiscard]] inline double size_of(const Vec3d& v) {
  const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
  return x > y ? (x > z ? x : z) : (y > z ? y : z);
}

/// A linear map and a snapped centre, both in grid units; none for a map that flattens or is not
/// finite.
struct GridFrame {
  Vec3d x, y, z;  ///< images of a local millimetre along each axis
  Vec3d centre;
  double reach = 0;  ///< size_of(centre)

  [[nodiscard]] Vec3d turned(const Vec3d& local) const {
    return x * local.x + y * local.y + z * local.z;
  }
  [[nodiscard]] Vec3d placed(const Vec3d& local) const { return centre + turned(local); }
};
[[nodiscard]] std::optional<GridFrame> grid_frame(const Placement& placement, const Vec3l& origin);

}  // namespace strake::geometry::primitive_pairs
