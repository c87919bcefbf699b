// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A primitive and the placement of the body that it is; the translation counts as snapped.
struct PlacedPrimitive {
  const Primitive* primitive = nullptr;
  const Placement* placement = nullptr;
};

/// Signed separation of two true surfaces, no tessellation between. All lengths are grid units.
struct AnalyticSeparation {
  double d = 0;      ///< distance, or minus the depth D of docs/clash.md
  double error = 0;  ///< certain bound on the error of d
  Vec3d point;  ///< midpoint of the closest pair or deepest point, relative to a's snapped centre
  /// Unit: the way along which a moves away from b. Apart, the closest points are point ± away·d/2,
  /// a's first. Otherwise the deepest point comes out when a moves d this way: the nearest point of
  /// the skin that d is measured to is point - away·D where `deep_in_a`, else point + away·D.
  Vec3d away{1, 0, 0};
  bool deep_in_a = false;
  /// How deep one lies wholly inside the other; negative: it sticks out by that much.
  double a_inside_b = 0, b_inside_a = 0;
  double difference = 0;  ///< bound on how far the two surfaces lie apart: 0 for duplicates
};

/// Closed forms for a sphere and a sphere, cylinder or box, and for cylinders with parallel axes;
/// placements must be rotations, mirrored or not, with scales that leave the kind as it is. What
/// the rounding of a source's matrices makes of right angles and parallel axes is part of `error`.
/// Nothing for any other pair.
[[nodiscard]] std::optional<AnalyticSeparation> analytic_separation(const PlacedPrimitive& a,
                                                                    const PlacedPrimitive& b);

}  // namespace strake::geometry
