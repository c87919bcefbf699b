// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "strake/geometry/exact_normal.hpp"
#include "strake/geometry/vec.hpp"
#include "strake/geometry/wide_int.hpp"

namespace strake::hlr {

using geometry::along;
using geometry::Int128;
using geometry::NormalVector;
using geometry::triangle_normal;
using geometry::wide_cross;

[[nodiscard]] constexpr bool is_zero(const NormalVector& n) {
  return n[0] == 0 && n[1] == 0 && n[2] == 0;
}

/// From where something is seen: from afar in a direction, or from a point in its coordinates.
struct Viewer {
  geometry::Vec3l direction;
  std::optional<geometry::Vec3l> eye = std::nullopt;

  /// Positive where a face with this normal through `on` looks towards the viewer; with an eye the
  /// height of the eye over its plane. For the normal of one triangle.
  [[nodiscard]] constexpr Int128 facing(const NormalVector& normal,
                                        const geometry::Vec3l& on) const {
    return along(normal, eye ? *eye - on : direction);
  }
  /// Whether that is positive, for the sum of as many normals as may be.
  [[nodiscard]] constexpr bool is_towards(const NormalVector& normal,
                                          const geometry::Vec3l& on) const {
    if (!eye) return along(normal, direction) > 0;
    const geometry::Vec3l to = *eye - on;
    return geometry::mul(normal[0], to.x) + geometry::mul(normal[1], to.y) +
               geometry::mul(normal[2], to.z) >
           geometry::Int256(0);
  }
  /// Whether a segment is a point on paper.
  [[nodiscard]] constexpr bool sees_as_point(const geometry::Vec3l& a,
                                             const geometry::Vec3l& b) const {
    return is_zero(wide_cross(b - a, eye ? *eye - a : direction));
  }
  /// The same in the coordinates of what is placed at an offset.
  [[nodiscard]] constexpr Viewer seen_at(const geometry::Vec3l& offset) const {
    return eye ? Viewer{direction, *eye - offset} : *this;
  }
};

}  // namespace strake::hlr
