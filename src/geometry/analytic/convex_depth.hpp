// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/analytic/cutting_planes.hpp"
#include "geometry/analytic/inner_field.hpp"

namespace strake::geometry::analytic {

/// A convex body with what is known of its inside, as deepest() wants it.
class DeepBody {
 public:
  DeepBody(const ConvexBody& body, const InnerField& field) : body_(body), field_(field) {}

  [[nodiscard]] const Vec3d& middle() const { return body_.middle; }
  [[nodiscard]] double extent() const { return 4 * body_.radius + body_.error; }
  [[nodiscard]] double bound(const Vec3d& n) const { return half_space(body_, n, 1).offset; }
  [[nodiscard]] double certain(const Vec3d& x) const { return field_.nearest(x).certain; }
  [[nodiscard]] DepthLook look(const Vec3d& x, double r) const;

 private:
  const ConvexBody& body_;
  const InnerField& field_;
};

/// A convex body as the room of the deepest point.
struct ConvexRoom {
  const ConvexBody& body;

  [[nodiscard]] const ConvexBody& hull() const { return body; }
  [[nodiscard]] Vec3d real(const Vec3d& x) const { return x; }
};

}  // namespace strake::geometry::analytic
