// SPDX-License-Identifier: Apache-2.0
#include "geometry/analytic/torus_pair.hpp"

#include <algorithm>

#include "geometry/analytic/bracket.hpp"
#include "geometry/analytic/depth_search.hpp"
#include "geometry/analytic/inside.hpp"
#include "geometry/analytic/pair_side.hpp"
#include "geometry/analytic/torus_gap.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::geometry::analytic {
namespace {

/// Nearest points to and fro: each step can only bring the two nearer, and of two that touch it
/// takes them onto the skins.
void draw_together(const PairSide& a, const PairSide& b, ConvexGap& gap) {
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

AnalyticSeparation meeting(const PairSide& a, const PairSide& b, ConvexGap gap) {
  DepthSearch search(a, b);
  const DeepestPoint depth = search.run();
  if (!(depth.lower > 0)) {
    draw_together(a, b, gap);
    AnalyticSeparation s = not_overlapping(gap, -depth.upper, gap.upper);
    s.depth_complete = depth.complete;
    return s;
  }
  AnalyticSeparation s = overlapping(depth, -depth.upper, kTorusDepth);
  s.deep_in_a = search.deep_in_a();
  const PairSide& in = s.deep_in_a ? a : b;
  const Vec3d out =
      in.torus ? in.torus->way_out(depth.point) : in.field->nearest(depth.point).normal;
  s.away = s.deep_in_a ? -out : out;
  s.a_inside_b = inside_by(a, b);
  s.b_inside_a = inside_by(b, a);
  if (!a.flat() && !b.flat()) s.difference = std::max(-s.a_inside_b, -s.b_inside_a);
  return s;
}

}  // namespace

std::optional<AnalyticSeparation> torus_separation(const PlacedPrimitive& a,
                                                   const PlacedPrimitive& b, double enough) {
  const auto origin = snap(a.placement->translation);
  PairSide x, y;
  if (!origin || !x.read(a, *origin) || !y.read(b, *origin) || !(x.torus || y.torus))
    return std::nullopt;
  GapSearch search(x, y, enough);
  const ConvexGap gap = search.run();
  if (gap.lower > 0) {
    AnalyticSeparation s =
        not_overlapping(gap, gap.lower, gap.lower >= enough ? gap.lower : gap.upper);
    s.sheet_a = x.flat();
    s.sheet_b = y.flat();
    return s;
  }
  if (x.flat() || y.flat() || (x.convex && !x.field) || (y.convex && !y.field)) return std::nullopt;
  if (gap.upper <= kTouch) {
    const double touch = search.touch_bound();
    if (touch >= -kTouch) return not_overlapping(gap, std::min(touch, gap.upper), gap.upper);
  }
  return meeting(x, y, gap);
}

}  // namespace strake::geometry::analytic
