// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geometry/analytic/convex_gap.hpp"
#include "geometry/analytic/inner_field.hpp"
#include "geometry/analytic/torus.hpp"

namespace strake::geometry::analytic {

/// One body of a pair: convex, or a torus that is cut into arcs. A convex body counts as one arc.
struct PairSide {
  std::optional<ConvexBody> convex;
  std::optional<InnerField> field;  ///< of a convex body with thickness
  std::optional<Torus> torus;

  /// False for what is neither.
  bool read(const PlacedPrimitive& p, const Vec3l& origin) {
    torus = Torus::of(p, origin);
    if (torus) return true;
    convex = convex_body(p, origin);
    if (convex) field = InnerField::of(p, *convex, origin);
    return convex.has_value();
  }
  /// A flat convex body, and the centre line of an arc.
  [[nodiscard]] static PairSide of(const ConvexBody& flat) {
    PairSide side;
    side.convex = flat;
    return side;
  }
  [[nodiscard]] static PairSide of(const Torus& line) {
    PairSide side;
    side.torus = line;
    return side;
  }
  [[nodiscard]] std::vector<Arc> arcs() const {
    return torus ? torus->arcs() : std::vector<Arc>(1);
  }
  [[nodiscard]] ConvexBody hull(const Arc& arc) const { return torus ? torus->hull(arc) : *convex; }
  /// A point of a hull taken into the body.
  [[nodiscard]] Vec3d real(const Vec3d& p) const { return torus ? torus->nearest(p) : p; }
  /// Of the body's points the nearest one, as Torus::nearest() and convex_gap() tell it.
  [[nodiscard]] Vec3d nearest(const Vec3d& p) const {
    return torus ? torus->nearest(p) : convex_gap(point_body(p), *convex).on_b;
  }
  [[nodiscard]] double error() const { return torus ? torus->error() : convex->error; }
  [[nodiscard]] bool flat() const { return torus ? torus->flat() : convex->flat; }
  /// How far the hull of an arc may stand off the body, at most: what splitting it lessens.
  [[nodiscard]] double slack(const Arc& arc) const {
    const double angle = arc.to - arc.from;
    return torus ? torus->radius() * angle * angle : 0;
  }
};

}  // namespace strake::geometry::analytic
