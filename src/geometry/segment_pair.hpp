// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// Where two segments p + s·d and q + t·e are nearest to each other, s and t in [0, 1].
struct SegmentPair {
  double s = 0, t = 0;
};

/// By clamped minimisation in double arithmetic. Rounding may miss the nearest points, but any s
/// and t give points of the segments: an upper bound of their distance. Where d or e is zero they
/// may be no numbers.
[[nodiscard]] inline SegmentPair nearest_on_segments(const Vec3d& p, const Vec3d& d, const Vec3d& q,
                                                     const Vec3d& e) {
  const auto clamp01 = [](double x) { return x < 0 ? 0 : x > 1 ? 1 : x; };
  const Vec3d r = p - q;
  const double dd = dot(d, d), ee = dot(e, e), de = dot(d, e), dr = dot(d, r), er = dot(e, r);
  const double denominator = dd * ee - de * de;
  const double s = denominator > 0 ? clamp01((de * er - dr * ee) / denominator) : 0;
  const double t = (de * s + er) / ee;
  if (t < 0) return {clamp01(-dr / dd), 0};
  if (t > 1) return {clamp01((de - dr) / dd), 1};
  return {s, t};
}

}  // namespace strake::geometry
