// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "geometry/primitive_pairs/pair_solvers.hpp"
#include "geometry/primitive_pairs/separation_bracket.hpp"
#include "geometry/primitive_pairs/solvers/containment_depth.hpp"
#include "geometry/primitive_pairs/solvers/primitive_operand.hpp"
#include "geometry/primitive_pairs/solvers/torus_branch_and_bound.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::geometry::primitive_pairs {
namespace {

/// Alternates nearest points: each step can only bring the two nearer, and where the bodies touch
/// it takes them onto the surfaces.
void draw_together(const PrimitiveOperand& a, const PrimitiveOperand& b, GjkResult& gap) {
  constexpr int kMaxSteps = 8;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vec3d p = a.nearest(gap.on_b), q = b.nearest(p);
    const double apart = norm(p - q) + a.error() + b.error();
    if (!(apart < gap.upper)) return;
    gap.upper = apart;
    gap.on_a = p;
    gap.on_b = q;
  }
}

PrimitiveSeparation meeting(const PrimitiveOperand& a, const PrimitiveOperand& b, GjkResult gap) {
  TorusDepthSearch search(a, b);
  const DeepestPoint depth = search.run();
  if (!(depth.lower > 0)) {
    draw_together(a, b, gap);
    PrimitiveSeparation s = disjoint_separation(gap, -depth.upper, gap.upper);
    s.depth_complete = depth.complete;
    return s;
  }
  PrimitiveSeparation s = overlapping_separation(depth, -depth.upper, kTorusDepthTolerance);
  s.deep_in_a = search.deep_in_a();
  const PrimitiveOperand& in = s.deep_in_a ? a : b;
  const Vec3d out =
      in.torus ? in.torus->exit_direction(depth.point) : in.field->nearest(depth.point).normal;
  s.away = s.deep_in_a ? -out : out;
  s.a_inside_b = containment_depth(a, b);
  s.b_inside_a = containment_depth(b, a);
  if (!a.flat() && !b.flat()) s.difference = std::max(-s.a_inside_b, -s.b_inside_a);
  return s;
}

}  // namespace

std::optional<PrimitiveSeparation> torus_separation(const PlacedPrimitive& a,
                                                    const PlacedPrimitive& b, double cutoff) {
  const auto origin = snap(a.placement->translation);
  PrimitiveOperand x, y;
  if (!origin || !x.read(a, *origin) || !y.read(b, *origin) || !(x.torus || y.torus))
    return std::nullopt;
  TorusDistanceSearch search(x, y, cutoff);
  const GjkResult gap = search.run();
  if (gap.lower > 0) {
    PrimitiveSeparation s =
        disjoint_separation(gap, gap.lower, gap.lower >= cutoff ? gap.lower : gap.upper);
    s.sheet_a = x.flat();
    s.sheet_b = y.flat();
    return s;
  }
  if (x.flat() || y.flat() || (x.convex && !x.field) || (y.convex && !y.field)) return std::nullopt;
  if (gap.upper <= kTouch) {
    const double touch = search.touch_bound();
    if (touch >= -kTouch) return disjoint_separation(gap, std::min(touch, gap.upper), gap.upper);
  }
  return meeting(x, y, gap);
}

}  // namespace strake::geometry::primitive_pairs
