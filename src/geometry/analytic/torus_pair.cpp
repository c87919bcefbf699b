// SPDX-License-Identifier: Apache-2.0
#include "geometry/analytic/torus_pair.hpp"

#include <algorithm>
#include <limits>

#include "geometry/analytic/depth_search.hpp"
#include "geometry/analytic/inside.hpp"
#include "geometry/analytic/pair_side.hpp"
#include "geometry/analytic/torus_gap.hpp"
#include "strake/geometry/grid.hpp"

namespace strake::geometry::analytic {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
AnalyticSeparation bracket(double lower, double upper) {
  AnalyticSeparation s;
  s.d = (lower + upper) / 2;
  s.error = (upper - lower) / 2;
  s.a_inside_b = s.b_inside_a = -s.d;
  s.difference = kNever;
  return s;
}

AnalyticSeparation apart(const ConvexGap& gap, double lower, double upper) {
  AnalyticSeparation s = bracket(lower, upper);
  s.point = (gap.on_a + gap.on_b) * 0.5;
  const Vec3d way = gap.on_a - gap.on_b;
  const double length = norm(way);
  s.away = length > gap.upper / 2 ? way * (1 / length) : gap.normal;
  return s;
}

AnalyticSeparation meeting(const PairSide& a, const PairSide& b, const ConvexGap& gap) {
  DepthSearch search(a, b);
  const DeepestPoint depth = search.run();
  if (!(depth.lower > 0)) return apart(gap, -depth.upper, std::max(gap.upper, -depth.upper));
  AnalyticSeparation s = bracket(-depth.upper, -depth.lower);
  s.point = depth.point;
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
    AnalyticSeparation s = apart(gap, gap.lower, gap.lower >= enough ? gap.lower : gap.upper);
    s.sheet_a = x.flat();
    s.sheet_b = y.flat();
    return s;
  }
  if (x.flat() || y.flat() || (x.convex && !x.field) || (y.convex && !y.field)) return std::nullopt;
  if (gap.upper <= kTouch) {
    const double touch = search.touch_bound();
    if (touch >= -kTouch) return apart(gap, std::min(touch, gap.upper), gap.upper);
  }
  return meeting(x, y, gap);
}

}  // namespace strake::geometry::analytic
