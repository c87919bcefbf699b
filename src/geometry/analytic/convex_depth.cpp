// SPDX-License-Identifier: Apache-2.0
#include "geometry/analytic/convex_depth.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "geometry/analytic/convex_gap.hpp"
#include "geometry/depth/radius_simplex.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry::analytic {
namespace {

constexpr int kMaxSteps = 200;

/// The half-space of a body with this unit normal, moved by `from`.
RadiusConstraint half_space(const ConvexBody& body, const Vec3d& n, double weight,
                            const Vec3d& from) {
  const Vec3d at = support(body.shape, n) - from;
  return {n, weight, dot(n, at) + body.error};
}

class Search {
 public:
  Search(const DeepBody& measured, const ConvexBody& room)
      : measured_(measured), room_(room), from_(measured.body->middle) {}

  ConvexDepth run(double enough) {
    std::array<RadiusConstraint, 4> first;
    for (std::size_t i = 0; i < 4; ++i)
      first[i] = half_space(*measured_.body, tetrahedral_directions()[i], 1, from_);
    RadiusSimplex simplex(first, 4 * measured_.body->radius + measured_.body->error);
    result_.upper = std::numeric_limits<double>::infinity();
    for (; result_.steps < kMaxSteps && simplex.load(); ++result_.steps) {
      result_.upper = std::min(result_.upper, simplex.proven_upper());
      const RadiusConstraint cut = cut_at(simplex.x(), simplex.r());
      if (result_.upper - result_.lower <= kDepthTolerance || result_.upper <= enough) break;
      if (!(simplex.excess(cut) > 0)) break;
      if (!simplex.exchange(cut, static_cast<std::size_t>(result_.steps) + 4)) break;
    }
    return result_;
  }

 private:
  /// The more violated of the two bodies' half-spaces at a vertex of the program, and a point of
  /// the room beside it, which is tried for the lower bound.
  RadiusConstraint cut_at(const Vec3d& x, double r) {
    const Vec3d at = x + from_;
    const ConvexGap to_room = convex_gap(point_body(at), room_);
    InnerField::Nearest near = measured_.field->nearest(at);
    if (to_room.upper > kGapTolerance)
      improve(to_room.on_b, measured_.field->nearest(to_room.on_b).certain - room_.error);
    else
      improve(at, near.certain - to_room.upper - room_.error);
    if (!(near.certain > 0)) look_from_outside(at, near);
    if (to_room.lower > r - near.depth) return half_space(room_, to_room.normal, 0, from_);
    return half_space(*measured_.body, near.normal, 1, from_);
  }

  /// Outside, where the nearest face may not be the one to look at: what parts the two.
  void look_from_outside(const Vec3d& at, InnerField::Nearest& near) const {
    const ConvexGap gap = convex_gap(point_body(at), *measured_.body);
    if (!(gap.lower > 0)) return;
    near.depth = -gap.lower;
    near.normal = gap.normal;
  }

  void improve(const Vec3d& at, double depth) {
    if (!(depth > result_.lower)) return;
    result_.lower = depth;
    result_.point = at;
  }

  const DeepBody& measured_;
  const ConvexBody& room_;
  Vec3d from_;
  ConvexDepth result_;
};

}  // namespace

ConvexDepth deepest_in(const DeepBody& measured, const ConvexBody& room, double enough) {
  return Search(measured, room).run(enough);
}

}  // namespace strake::geometry::analytic
