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
  double error = 0;  ///< how far this may displace a point of the placed primitive
};

/// Returns a primitive that has closed forms. Nothing for other kinds, for lengths of zero, and for
/// placements that do not preserve the kind. Axes that the source's rounding has taken off the
/// right angle are made orthonormal, and the displacement is `error`; beyond kMaxOrthonormalError
/// it is a different body.
[[nodiscard]] std::optional<RigidPrimitive> rigid_primitive(const PlacedPrimitive& p);

/// Grid units: well below the sag of a tessellation, well above single-precision matrices at ten
/// metres.
inline constexpr double kMaxOrthonormalError = 10;

/// Orthonormal axes and one scale for a map that is a similarity but for rounding; `moved` (the
/// unit of `reach`) bounds the displacement of points within `reach` of the centre.
struct OrthonormalFrame {
  std::array<Vec3d, 3> axes;
  double scale = 1, moved = 0;
};
/// Returns such axes; nothing where `moved` exceeds kMaxOrthonormalError. Lengths are millimetres.
[[nodiscard]] std::optional<OrthonormalFrame> orthonormalised(const Mat3d& linear, double reach);

}  // namespace strake::geometry::primitive_pairs
