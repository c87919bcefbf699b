// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "geometry/primitive_pairs/pair_solvers.hpp"
#include "geometry/primitive_pairs/separation_bracket.hpp"
#include "geometry/primitive_pairs/solvers/containment_depth.hpp"
#include "geometry/primitive_pairs/solvers/convex_depth.hpp"
#include "geometry/primitive_pairs/solvers/gjk.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::geometry::primitive_pairs {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Grid units: two that overlap by no more along some direction, and are no farther apart, touch as
/// far as this can tell.
constexpr double kTouchDistance = 1;

/// Two bodies that meet, or nearly so.
class OverlappingPair {
 public:
  OverlappingPair(const PlacedPrimitive& a, const ConvexBody& body_a, const PlacedPrimitive& b,
                  const ConvexBody& body_b, const Vec3l& origin)
      : a_(body_a),
        b_(body_b),
        field_a_(InteriorDistance::of(a, body_a, origin)),
        field_b_(InteriorDistance::of(b, body_b, origin)) {}

  [[nodiscard]] bool measurable() const {
    return (field_a_ || a_.flat) && (field_b_ || b_.flat) && (field_a_ || field_b_);
  }

  [[nodiscard]] PrimitiveSeparation separation(GjkResult gap) const {
    raise_bound_along_faces(gap, field_a_, 1);
    raise_bound_along_faces(gap, field_b_, -1);
    if (gap.lower >= -kTouchDistance && gap.upper <= kTouchDistance)
      return disjoint_separation(gap, gap.lower, gap.upper);
    DeepestPoint depth;
    bool deep_in_a = true;
    depth.upper = -kInfinity;
    if (field_a_)
      depth = maximise_depth(ConvexDepthOracle(a_, *field_a_), ConvexDomain{b_}, -kInfinity);
    if (field_b_) {
      const DeepestPoint other =
          maximise_depth(ConvexDepthOracle(b_, *field_b_), ConvexDomain{a_}, depth.lower);
      if (other.lower > depth.lower) {
        depth.lower = other.lower;
        depth.point = other.point;
        deep_in_a = false;
      }
      depth.upper = std::max(depth.upper, other.upper);
      depth.complete = depth.complete && other.complete;
    }
    if (field_a_ && field_b_ && depth.lower > 0)
      depth.point =
          deep_in_a
              ? centre_of_deep_points({a_, *field_a_}, {b_, *field_b_}, depth.point, depth.lower)
              : centre_of_deep_points({b_, *field_b_}, {a_, *field_a_}, depth.point, depth.lower);
    PrimitiveSeparation s = summary(gap, depth, deep_in_a);
    if (field_b_) s.a_inside_b = containment_depth(a_, b_, *field_b_);
    if (field_a_) s.b_inside_a = containment_depth(b_, a_, *field_a_);
    if (field_a_ && field_b_) s.difference = std::max(-s.a_inside_b, -s.b_inside_a);
    return s;
  }

 private:
  /// For bodies that touch along a flat face no separating plane is better than a face of either.
  void raise_bound_along_faces(GjkResult& gap, const std::optional<InteriorDistance>& field,
                               double side) const {
    for (std::size_t i = 0; field && i < field->planes(); ++i) {
      const Vec3d n = field->normal(i) * -side;
      const double slab = dot(n, support(a_.shape, -n) - support(b_.shape, n));
      gap.lower = std::max(gap.lower, slab - a_.error - b_.error);
    }
  }

  [[nodiscard]] PrimitiveSeparation summary(const GjkResult& gap, const DeepestPoint& depth,
                                            bool deep_in_a) const {
    const double lower = std::max(-depth.upper, gap.lower);
    if (!(depth.lower > 0)) {
      PrimitiveSeparation s = disjoint_separation(gap, lower, std::max(gap.upper, -depth.upper));
      s.depth_complete = depth.complete;
      return s;
    }
    PrimitiveSeparation s = overlapping_separation(depth, lower, kDepthTolerance);
    s.deep_in_a = deep_in_a;
    const Vec3d out = (deep_in_a ? field_a_ : field_b_)->nearest(depth.point).normal;
    s.away = deep_in_a ? -out : out;
    return s;
  }

  const ConvexBody &a_, &b_;
  std::optional<InteriorDistance> field_a_, field_b_;
};

}  // namespace

std::optional<PrimitiveSeparation> convex_separation(const PlacedPrimitive& a,
                                                     const PlacedPrimitive& b, double cutoff) {
  const auto origin = snap(a.placement->translation);
  if (!origin) return std::nullopt;
  const auto x = convex_body(a, *origin), y = convex_body(b, *origin);
  if (!x || !y) return std::nullopt;
  const GjkResult gap = gjk_distance(*x, *y, cutoff);
  PrimitiveSeparation s;
  if (gap.lower > 0) {
    s = disjoint_separation(gap, gap.lower, gap.lower >= cutoff ? gap.lower : gap.upper);
  } else {
    const OverlappingPair meeting(a, *x, b, *y, *origin);
    if (!meeting.measurable()) return std::nullopt;
    s = meeting.separation(gap);
  }
  s.sheet_a = x->flat;
  s.sheet_b = y->flat;
  return s;
}

}  // namespace strake::geometry::primitive_pairs
