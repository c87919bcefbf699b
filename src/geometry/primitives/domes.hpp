// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geometry/primitives/mesh_builder.hpp"

namespace strake::geometry::tessellation {

/// The contour of a spherical dish in a view: part of a great circle of its ball.
struct CapContour {
  double ball = 0;    ///< radius
  double centre = 0;  ///< of the ball, along the axis
  Vec3d out, across;  ///< unit, level: towards the viewer, and at right angles to that
  double at = 0;      ///< along `out`, where the contour meets the rim
  double half = 0;    ///< along `across` to either side
  double tilt = 0;    ///< from the axis towards `out`, where the contour is highest

  /// None where the contour does not meet the rim, or the dish is seen along its axis. For lengths
  /// that are not zero; `towards` is a unit direction.
  [[nodiscard]] static std::optional<CapContour> of(const SphericalDishPrimitive& p,
                                                    const Vec3d& towards);
};

/// A spherical dish with its contour among the edges: `segments` to the rim, of which the contour's
/// two ends may take the place of some and near which there may be more, and `rows` from the rim to
/// the apex at least. None where the contour does not meet the rim or lies within a quarter of a
/// row of it.
[[nodiscard]] std::optional<Tessellation> contoured_cap(const SphericalDishPrimitive& p,
                                                        const TessellationTarget& target,
                                                        int segments, int rows);

}  // namespace strake::geometry::tessellation
