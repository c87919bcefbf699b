// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitive_pairs/separation_bracket.hpp"

namespace strake::geometry::primitive_pairs {

double nominal_separation(double lower, double upper, double tolerance) {
  const double middle = (lower + upper) / 2;
  if (!(upper < 0)) return lower > 0 ? middle : 0;
  return upper - lower <= tolerance ? middle : upper;
}

PrimitiveSeparation disjoint_separation(const GjkResult& gap, double lower, double upper) {
  PrimitiveSeparation s;
  s.lower = lower;
  s.upper = upper;
  s.d = nominal_separation(lower, upper, 0);
  s.point = (gap.on_a + gap.on_b) * 0.5;
  const Vec3d way = gap.on_a - gap.on_b;
  const double length = norm(way);
  s.away = length > gap.upper / 2 ? way * (1 / length) : gap.normal;
  return s;
}

PrimitiveSeparation overlapping_separation(const DeepestPoint& depth, double lower,
                                           double tolerance) {
  PrimitiveSeparation s;
  s.lower = lower;
  s.upper = -depth.lower;
  s.d = nominal_separation(s.lower, s.upper, tolerance);
  s.point = depth.point;
  s.depth_complete = depth.complete;
  return s;
}

}  // namespace strake::geometry::primitive_pairs
