// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "geometry/primitive_pairs/shapes/support_mapping.hpp"
#include "strake/geometry/primitive_separation.hpp"

namespace strake::geometry::primitive_pairs {

/// A primitive that has closed forms, about its own centre. All lengths are grid units.
struct RigidPrimitive {
  enum class Kind : std::uint8_t { sphere, cylinder, box };
  Kind kind = Kind::sphere;
  /// Sphere: the radius. Cylinder along axis 2: radius, radius, half the height. Box: half its
  /// lengths.
  std::array<double, 3> half{};
  std::array<Vec3d, 3> axes;  ///< orthonormal
  Vec3l centre;
  double error = 0;  ///< how far a point of the placed primitive may lie from where this puts it
};

/// Nothing for other kinds, for lengths of zero, and for placements that do not leave the kind as
/// it is. Axes that are off the right angle by the rounding of a source's numbers are put right,
/// and what that moves is `error`; beyond kMaxOrthonormalError it is a different body.
[[nodiscard]] std::optional<RigidPrimitive> rigid_primitive(const PlacedPrimitive& p);

/// Grid units: well below the sag of a tessellation, well above single-precision matrices at ten
/// metres.
inline constexpr double kMaxOrthonormalError = 10;

/// Orthonormal axes and one scale for a map that is a similarity but for rounding; `moved` (the
/// unit of `reach`) is how far it takes a point within `reach` of the centre from where these do.
struct OrthonormalFrame {
  std::array<Vec3d, 3> axes;
  double scale = 1, moved = 0;
};
/// Nothing where that is more than kMaxOrthonormalError; lengths are millimetres.
[[nodiscard]] std::optional<OrthonormalFrame> orthonormalised(const Mat3d& linear, double reach);

}  // namespace strake::geometry::primitive_pairs
