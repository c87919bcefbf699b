// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geometry/primitive_pairs/shapes/interior_distance.hpp"
#include "geometry/primitive_pairs/shapes/torus.hpp"
#include "geometry/primitive_pairs/solvers/gjk.hpp"

namespace strake::geometry::primitive_pairs {

/// One body of a pair: convex, or a torus that is split into arcs. A convex body counts as one arc.
struct PrimitiveOperand {
  std::optional<ConvexBody> convex;
  std::optional<InteriorDistance> field;  ///< of a convex body with thickness
  std::optional<Torus> torus;

  /// Reads a primitive; false for what is neither.
  bool read(const PlacedPrimitive& p, const Vec3l& origin) {
    torus = Torus::of(p, origin);
    if (torus) return true;
    convex = convex_body(p, origin);
    if (convex) field = InteriorDistance::of(p, *convex, origin);
    return convex.has_value();
  }
  /// Makes an operand of a flat convex body, or of the centre line of an arc.
  [[nodiscard]] static PrimitiveOperand of(const ConvexBody& flat) {
    PrimitiveOperand side;
    side.convex = flat;
    return side;
  }
  [[nodiscard]] static PrimitiveOperand of(const Torus& line) {
    PrimitiveOperand side;
    side.torus = line;
    return side;
  }
  [[nodiscard]] std::vector<SweptArc> arcs() const {
    return torus ? torus->arcs() : std::vector<SweptArc>(1);
  }
  [[nodiscard]] ConvexBody hull(const SweptArc& arc) const {
    return torus ? torus->hull(arc) : *convex;
  }
  /// Maps a point of a hull into the body.
  [[nodiscard]] Vec3d point_in_body(const Vec3d& p) const { return torus ? torus->nearest(p) : p; }
  /// Returns the body's point nearest to p, as by Torus::nearest() and gjk_distance().
  [[nodiscard]] Vec3d nearest(const Vec3d& p) const {
    return torus ? torus->nearest(p) : gjk_distance(point_body(p), *convex).on_b;
  }
  [[nodiscard]] double error() const { return torus ? torus->error() : convex->error; }
  [[nodiscard]] bool flat() const { return torus ? torus->flat() : convex->flat; }
  /// Returns how far the hull of an arc may lie off the body at most; splitting the arc reduces it.
  [[nodiscard]] double hull_error(const SweptArc& arc) const {
    const double angle = arc.to - arc.from;
    return torus ? torus->radius() * angle * angle : 0;
  }
};

}  // namespace strake::geometry::primitive_pairs
