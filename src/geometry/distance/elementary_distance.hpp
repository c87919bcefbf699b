// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/numeric/triangle_math.hpp"
#include "strake/geometry/vec.hpp"

// Distances of points, segments, triangles and boxes in doubles.

namespace strake::geometry {

/// The parameters s and t in [0, 1] at which the segments p + s·d and q + t·e are nearest to each
/// other.
struct SegmentParameters {
  double s = 0, t = 0;
};

/// Returns the nearest points by clamped minimisation in double arithmetic. Rounding may miss them,
/// but any s and t give points of the segments, hence an upper bound of their distance. Where d or
/// e is zero, s and t may be NaN.
[[nodiscard]] inline SegmentParameters closest_on_segments(const Vec3d& p, const Vec3d& d,
                                                           const Vec3d& q, const Vec3d& e) {
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

/// Whether a segment may meet a box; false is certain. The separating axes are those of the box and
/// their cross products with the segment.
[[nodiscard]] inline bool may_meet(const Vec3d& from, const Vec3d& to, const Box3d& box) {
  const Vec3d centre = (box.lo + box.hi) * 0.5, half = (box.hi - box.lo) * 0.5;
  const Vec3d middle = (from + to) * 0.5 - centre, along = (to - from) * 0.5;
  const Vec3d reach{std::fabs(along.x), std::fabs(along.y), std::fabs(along.z)};
  for (int k = 0; k < 3; ++k)
    if (std::fabs(middle[k]) > half[k] + reach[k]) return false;
  const Vec3d across = cross(along, middle);
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double largest = half[i] * reach[j] + half[j] * reach[i];
    const double rounding =
        1e-12 * (largest + std::fabs(along[i] * middle[j]) + std::fabs(along[j] * middle[i]));
    if (std::fabs(across[k]) > largest + rounding) return false;
  }
  return true;
}

/// Returns the squared distance of a point to a triangle, in doubles.
[[nodiscard]] inline double squared_distance(const Vec3d& p, const Corners& t) {
  const Vec3d u = t[1] - t[0], v = t[2] - t[0], n = cross(u, v);
  double least = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d &from = t[i], e = t[(i + 1) % 3] - from, d = p - from;
    inside = inside && dot(cross(e, d), n) >= 0;
    const double along = std::clamp(dot(e, d) / dot(e, e), 0.0, 1.0);
    const Vec3d off = d - e * along;
    least = std::min(least, dot(off, off));
  }
  if (!inside) return least;
  const double height = dot(n, p - t[0]);
  return std::min(least, height * height / dot(n, n));
}

}  // namespace strake::geometry
