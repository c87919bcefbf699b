// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geometry/primitives/mesh_builder.hpp"

namespace strake::geometry::tessellation {

/// The silhouette of a spherical dish in a view that meets the base circle: part of a circle of its
/// ball, a great one unless an eye sees it.
struct CapContour {
  double ball = 0;    ///< radius
  double centre = 0;  ///< of the ball, along the axis
  Vec3d out, across;  ///< unit, horizontal: towards the viewer, and perpendicular to that
  double at = 0;      ///< along `out`, where the silhouette meets the base circle
  double half = 0;    ///< along `across` to either side
  double tilt = 0;    ///< angle from the axis towards `out`, where the silhouette is highest

  /// Returns the silhouette; none where it does not meet the base circle, or the dish is seen along
  /// its axis. Lengths are not zero; `towards` is a unit direction.
  [[nodiscard]] static std::optional<CapContour> of(const SphericalDishPrimitive& p,
                                                    const Vec3d& towards);
  /// The same from an eye; none where that is in the ball or at its skin, either.
  [[nodiscard]] static std::optional<CapContour> from(const SphericalDishPrimitive& p,
                                                      const Vec3d& eye);
};

/// Returns the ball of a spherical dish: its radius and where its centre lies, nothing else.
[[nodiscard]] CapContour ball_of(const SphericalDishPrimitive& p);

/// Returns a spherical dish with its silhouette among the edges: `segments` on the base circle, of
/// which the silhouette's two ends may replace some and near which there may be more, and at least
/// `rows` from the base to the apex. None where the silhouette does not meet the base circle or
/// lies within a quarter of a row of it.
[[nodiscard]] std::optional<Tessellation> contoured_cap(const SphericalDishPrimitive& p,
                                                        const TessellationTarget& target,
                                                        int segments, int rows);

/// Returns a spherical dish whose silhouette is a whole circle over the base circle, among its
/// edges, with the base circle of `rim`, to which one of more than half a ball may add. None where
/// the silhouette is no such circle or is too near to the base circle.
[[nodiscard]] std::optional<Tessellation> encircled_cap(const SphericalDishPrimitive& p,
                                                        const TessellationTarget& target,
                                                        const std::vector<SinCos>& rim, int rows);

}  // namespace strake::geometry::tessellation
