// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/segment_near.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace strake::geometry {
namespace {

double squared(const Vec3d& v) { return dot(v, v); }

/// The nearest points of two segments, by clamped minimisation.
SegmentNear between(const Vec3d& p, const Vec3d& d, const Vec3d& q, const Vec3d& e) {
  const Vec3d r = p - q;
  const double dd = dot(d, d), ee = dot(e, e), de = dot(d, e), dr = dot(d, r), er = dot(e, r);
  const double denominator = dd * ee - de * de;
  const auto on_d = [&](double t) { return std::clamp((de * t - dr) / dd, 0.0, 1.0); };
  double s = denominator > 0 ? std::clamp((de * er - dr * ee) / denominator, 0.0, 1.0) : 0;
  const double t = std::clamp((de * s + er) / ee, 0.0, 1.0);
  s = on_d(t);
  return {squared(r + d * s - e * t), s};
}

bool within(const Vec3d& x, const Corners& t, const Vec3d& n) {
  for (std::size_t i = 0; i < 3; ++i)
    if (dot(cross(t[(i + 1) % 3] - t[i], x - t[i]), n) < 0) return false;
  return true;
}

}  // namespace

SegmentNear nearest_along(const Vec3d& from, const Vec3d& to, const Corners& t) {
  const Vec3d n = cross(t[1] - t[0], t[2] - t[0]), d = to - from;
  const std::array<double, 2> height{dot(n, from - t[0]), dot(n, to - t[0])};
  if ((height[0] <= 0 && height[1] >= 0) || (height[0] >= 0 && height[1] <= 0)) {
    const double s = height[0] == height[1] ? 0 : height[0] / (height[0] - height[1]);
    if (within(from + d * s, t, n)) return {0, s};
  }
  SegmentNear best{std::numeric_limits<double>::infinity(), 0};
  const auto offer = [&](const SegmentNear& near) {
    if (near.squared < best.squared) best = near;
  };
  for (const double end : {0.0, 1.0}) {
    const Vec3d p = end > 0 ? to : from;
    offer({squared(p - nearest_on_triangle(p, t)), end});
  }
  for (std::size_t i = 0; i < 3; ++i) offer(between(from, d, t[i], t[(i + 1) % 3] - t[i]));
  return best;
}

}  // namespace strake::geometry
