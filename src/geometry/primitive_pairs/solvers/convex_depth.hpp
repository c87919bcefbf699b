// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "geometry/interior_depth/bounds/inscribed_ball.hpp"
#include "geometry/primitive_pairs/shapes/convex_body.hpp"
#include "geometry/primitive_pairs/shapes/interior_distance.hpp"
#include "geometry/primitive_pairs/solvers/gjk.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry::primitive_pairs {

/// Grid units: a bracket of a depth this narrow ends the search.
inline constexpr double kDepthTolerance = 1.0 / 16;

/// The depth of a body at the deepest of the points that lie in another: lower <= depth <= upper is
/// certain. Negative `upper`: the two are apart.
struct DeepestPoint {
  double lower = 0, upper = std::numeric_limits<double>::infinity();
  Vec3d point;  ///< in both, `lower` deep in the first
  int steps = 0;
  bool complete = true;  ///< no work limit ended the search
};

/// The probe of a measured body at a point: its certain depth there, and the half-space (or its
/// substitute) that the ball of radius r about the point violates most.
struct DepthProbe {
  double certain = 0;
  BallConstraint cut;  ///< about the origin
};

/// Returns {x : n·x + weight·r <= the body's support along n}, about the origin.
[[nodiscard]] inline BallConstraint half_space(const ConvexBody& body, const Vec3d& n,
                                               double weight) {
  return {n, weight, dot(n, support(body.shape, n)) + body.error};
}

/// Returns the same constraint for x measured from elsewhere. The supports' errors cover its
/// rounding.
[[nodiscard]] inline BallConstraint moved(BallConstraint c, const Vec3d& from) {
  c.offset -= dot(c.normal, from);
  return c;
}

/// Returns the greatest r for which a ball of that radius lies in `measured` with its centre in
/// `domain`: a linear program in four variables over all half-spaces of both, whose cuts (Kelley
/// 1960) are generated as needed and added by the dual simplex method. Multipliers prove the upper
/// bound, a point of the domain with its certain depth the lower one. Ends when they agree to
/// kDepthTolerance, when the upper one falls to `cutoff`, or when nothing is violated by more than
/// a part of that.
///
/// Measured: middle(), extent() and bound(n) give a point, a bound on coordinates about it, and a
/// bound on n·x + r; probe(x, r) is a DepthProbe; certain(x) is the depth at a point of the body.
/// Domain: hull() is a convex set; point_in_body(x) maps one of its points into the body that it
/// stands for.
template <class Measured, class Domain>
[[nodiscard]] DeepestPoint maximise_depth(const Measured& measured, const Domain& domain,
                                          double cutoff) {
  constexpr int kMaxSteps = 200;
  const Vec3d from = measured.middle();
  std::array<BallConstraint, 4> first;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d& n = tetrahedral_directions()[i];
    first[i] = moved({n, 1, measured.bound(n)}, from);
  }
  DualSimplex simplex(first, measured.extent());
  DeepestPoint result;
  const auto try_point = [&](const Vec3d& at, double depth) {
    if (!(depth > result.lower)) return;
    result.lower = depth;
    result.point = at;
  };
  for (; result.steps < kMaxSteps && simplex.load(); ++result.steps) {
    result.upper = std::min(result.upper, simplex.proven_upper());
    const Vec3d at = simplex.x() + from;
    const GjkResult to_domain = gjk_distance(point_body(at), domain.hull());
    const DepthProbe probe = measured.probe(at, simplex.r());
    const Vec3d point_in_body =
        domain.point_in_body(to_domain.upper > kGapTolerance ? to_domain.on_b : at);
    // Within the tolerance of the domain: it has a point that near.
    if (point_in_body == at)
      try_point(at, probe.certain - to_domain.upper - domain.hull().error);
    else
      try_point(point_in_body, measured.certain(point_in_body) - domain.hull().error);
    if (result.upper - result.lower <= kDepthTolerance || result.upper <= cutoff) break;
    BallConstraint cut = moved(probe.cut, from);
    if (to_domain.lower > simplex.excess(cut))
      cut = moved(half_space(domain.hull(), to_domain.normal, 0), from);
    if (!(simplex.excess(cut) > kDepthTolerance / 8)) break;
    if (simplex.exchange(cut, static_cast<std::size_t>(result.steps) + 4)) continue;
    // No point of the domain lies where the measured body is measured: an arc beside it.
    if (simplex.proves_empty(cut)) result.upper = std::min(result.upper, 0.0);
    break;
  }
  result.complete = result.steps < kMaxSteps;
  return result;
}

/// A convex body with its interior distance, as maximise_depth() takes it.
class ConvexDepthOracle {
 public:
  ConvexDepthOracle(const ConvexBody& body, const InteriorDistance& field)
      : body_(body), field_(field) {}

  [[nodiscard]] const Vec3d& middle() const { return body_.middle; }
  [[nodiscard]] double extent() const { return 4 * body_.radius + body_.error; }
  [[nodiscard]] double bound(const Vec3d& n) const { return half_space(body_, n, 1).offset; }
  [[nodiscard]] double certain(const Vec3d& x) const { return field_.nearest(x).certain; }
  [[nodiscard]] DepthProbe probe(const Vec3d& x, double r) const;

 private:
  const ConvexBody& body_;
  const InteriorDistance& field_;
};

/// A convex body as the domain of the deepest point.
struct ConvexDomain {
  const ConvexBody& body;

  [[nodiscard]] const ConvexBody& hull() const { return body; }
  [[nodiscard]] Vec3d point_in_body(const Vec3d& x) const { return x; }
};

/// A convex body and its interior distance.
struct ConvexInterior {
  const ConvexBody& body;
  const InteriorDistance& field;
};

/// Moves a point in both, `depth` deep in the first, towards the centre of the points in both that
/// are as deep: along one direction after another in which either body is measured, perpendicular
/// to the nearest surface. The result is in both and as deep but for a thousandth of a grid unit.
[[nodiscard]] Vec3d centre_of_deep_points(const ConvexInterior& deep, const ConvexInterior& domain,
                                          const Vec3d& from, double depth);

}  // namespace strake::geometry::primitive_pairs
