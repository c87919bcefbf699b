// SPDX-License-Identifier: Apache-2.0
#include "hlr/visibility/open_part.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace strake::hlr {
namespace {

/// The rounding of a point between two ends is far below this fraction of their coordinates.
constexpr double kRoundingOfPoint = 1e-12;

/// A closed interval of one coordinate, in whole units.
struct RoundedInterval {
  std::int64_t lo = 0, hi = 0;
};

/// Returns the interval of a coordinate, rounded outwards, that the open part runs through.
RoundedInterval reach_of(std::int64_t a, std::int64_t b, const OpenRange& open) {
  if (a == b) return {a, a};
  const std::int64_t step = b - a;
  const double slack =
      kRoundingOfPoint * (std::abs(static_cast<double>(a)) + std::abs(static_cast<double>(step)));
  const auto at = [&](const RationalParam& t) -> RoundedInterval {
    if (t.num == 0) return {a, a};
    if (t.num == t.den) return {b, b};
    const double x = static_cast<double>(a) + static_cast<double>(step) * t.value;
    return {static_cast<std::int64_t>(std::floor(x - slack)),
            static_cast<std::int64_t>(std::ceil(x + slack))};
  };
  const RoundedInterval p = at(open.lo()), q = at(open.hi());
  return {std::min(p.lo, q.lo), std::max(p.hi, q.hi)};
}

/// Returns what a box must meet in one coordinate. `above`: whether the left of the edge lies above
/// it in this coordinate, where the edge has no extent in it.
RoundedInterval to_meet(const RoundedInterval& reach, bool extends, bool above,
                        const OpenRange& open) {
  if (extends) return {reach.lo + 1, reach.hi - 1};
  if (open.is_open(kLeft) == open.is_open(kRight)) return reach;
  const bool open_above = open.is_open(kLeft) == above;
  return open_above ? RoundedInterval{reach.lo + 1, reach.hi}
                    : RoundedInterval{reach.lo, reach.hi - 1};
}

}  // namespace

ViewBox open_box(const ViewPoint& a, const ViewPoint& b, const OpenRange& open) {
  const std::int64_t du = b.u - a.u, dv = b.v - a.v;
  RoundedInterval u = reach_of(a.u, b.u, open), v = reach_of(a.v, b.v, open);
  const RoundedInterval w = reach_of(a.w, b.w, open);
  if (du != 0 || dv != 0) {
    u = to_meet(u, du != 0, dv < 0, open);
    v = to_meet(v, dv != 0, du > 0, open);
  }
  return {{u.lo, v.lo, w.lo}, {u.hi, v.hi, w.hi}};
}

SegmentQuery rotated_query(const ViewPoint& a, const ViewPoint& b, const OpenRange& open,
                           const PaperRotation& rotation) {
  SegmentQuery s;
  const std::int64_t whole = kExactInDouble / (2 * PaperRotation::kMax);
  const bool exact = std::max({std::abs(a.u), std::abs(a.v), std::abs(b.u), std::abs(b.v)}) < whole;
  const auto au = static_cast<double>(a.u), av = static_cast<double>(a.v);
  const double bu = static_cast<double>(b.u) - au, bv = static_cast<double>(b.v) - av;
  const double dw = static_cast<double>(b.w) - static_cast<double>(a.w);
  const auto c = static_cast<double>(rotation.c), k = static_cast<double>(rotation.s);
  const double du = c * bu + k * bv, dv = c * bv - k * bu;
  s.au = c * au + k * av;
  s.av = c * av - k * au;
  s.du = exact ? du : 0;
  s.dv = exact ? dv : 0;
  const auto range = [&](double from, double step, double size, double& least, double& largest) {
    const double p = from + step * open.lo().value, q = from + step * open.hi().value;
    const double slack = kRoundingOfPoint * size;
    least = std::min(p, q) - slack;
    largest = std::max(p, q) + slack;
  };
  const auto size = [&](double x, double y) { return std::abs(c * x) + std::abs(k * y); };
  double w1 = 0;
  range(s.au, du, size(au, av) + size(bu, bv), s.u0, s.u1);
  range(s.av, dv, size(av, au) + size(bv, bu), s.v0, s.v1);
  range(static_cast<double>(a.w), dw, std::abs(static_cast<double>(a.w)) + std::abs(dw), s.w0, w1);
  return s;
}

}  // namespace strake::hlr
