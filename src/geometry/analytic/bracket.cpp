// SPDX-License-Identifier: Apache-2.0
#include "geometry/analytic/bracket.hpp"

#include <algorithm>

namespace strake::geometry::analytic {
namespace {

AnalyticSeparation bracketed(double lower, double d, double upper) {
  AnalyticSeparation s;
  s.lower = lower;
  s.d = d;
  s.upper = upper;
  return s;
}

}  // namespace

AnalyticSeparation not_overlapping(const ConvexGap& gap, double lower, double upper) {
  AnalyticSeparation s = bracketed(lower, std::max((lower + upper) / 2, 0.0), upper);
  s.point = (gap.on_a + gap.on_b) * 0.5;
  const Vec3d way = gap.on_a - gap.on_b;
  const double length = norm(way);
  s.away = length > gap.upper / 2 ? way * (1 / length) : gap.normal;
  return s;
}

AnalyticSeparation overlapping(const DeepestPoint& depth, double lower, double tolerance) {
  const double upper = -depth.lower;
  const bool closed = upper - lower <= tolerance;
  AnalyticSeparation s = bracketed(lower, closed ? (lower + upper) / 2 : upper, upper);
  s.point = depth.point;
  return s;
}

}  // namespace strake::geometry::analytic
