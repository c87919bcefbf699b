// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// The curve centre + u cos t + v sin t, in the unit of its maker: u and v are conjugate
/// half-diameters.
struct Ellipse {
  Vec3d centre, u, v;

  /// Whether a point lies within `tolerance` of the curve, to the first order.
  [[nodiscard]] bool passes(const Vec3d& point, double tolerance) const;
};

/// Returns the circles of a round primitive under the linear part of its placement, millimetres
/// from its placed origin: the edges of its plane faces, and those of its silhouettes towards a
/// viewer that are plane. Its meshes for that view (tessellate) have their vertices on them; not
/// every circle is a line of every mesh. Snouts with sheared ends, and bends except in plan and
/// elevation, have fewer than a draughtsman would draw.
[[nodiscard]] std::vector<Ellipse> circles_of(const Primitive& primitive, const Mat3d& linear,
                                              const Vec3d& towards);

}  // namespace strake::geometry
