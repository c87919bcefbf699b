// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "geometry/primitive_pairs/shapes/torus.hpp"
#include "geometry/primitive_pairs/solvers/convex_depth.hpp"

namespace strake::geometry::primitive_pairs {

/// The points of a torus over one arc of its sweep, as maximise_depth() takes them. How deep they
/// lie in the torus is bounded by constraints that are convex over the arc, and exact as the arc
/// shrinks: the distance to the centre line by that to its hull, the distance from the axis by that
/// along the arc's middle.
class TorusArcInterior {
 public:
  TorusArcInterior(const Torus& torus, const SweptArc& arc);

  [[nodiscard]] const Vec3d& middle() const { return torus_.centre(); }
  [[nodiscard]] double extent() const { return 4 * torus_.radius() + torus_.error(); }
  /// Returns a bound on n·x + r: no ball in the torus reaches beyond the one round all of it.
  [[nodiscard]] double bound(const Vec3d& n) const {
    return dot(n, torus_.centre()) + torus_.radius() + torus_.error();
  }
  [[nodiscard]] double certain(const Vec3d& x) const {
    const double depth = torus_.depth(x) - torus_.error();
    return depth > 0 ? depth : 0;
  }
  [[nodiscard]] DepthProbe probe(const Vec3d& x, double r) const;

 private:
  void add(const Vec3d& local_normal, double weight, double offset);
  void bound_profile(const Vec3d& outward, double nearest);
  void bound_ends(const Vec3d& outward, double nearest, const SweptArc& arc);

  const Torus& torus_;
  ConvexBody spine_;
  std::array<BallConstraint, 9> fixed_{};
  std::size_t count_ = 0;
};

/// The hull of an arc as the domain of the deepest point; its points are mapped into the torus.
class TorusArcDomain {
 public:
  TorusArcDomain(const Torus& torus, const SweptArc& arc) : torus_(torus), hull_(torus.hull(arc)) {
    // A point mapped into the torus lies in it but for the error of its axes.
    hull_.error += torus.error();
  }
  [[nodiscard]] const ConvexBody& hull() const { return hull_; }
  [[nodiscard]] Vec3d point_in_body(const Vec3d& x) const { return torus_.nearest(x); }

 private:
  const Torus& torus_;
  ConvexBody hull_;
};

}  // namespace strake::geometry::primitive_pairs
