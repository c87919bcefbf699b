// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/segment_near.hpp"

#include <array>
#include <cstddef>
#include <limits>

#include "geometry/box.hpp"
#include "geometry/depth/nearest.hpp"
#include "geometry/segment_pair.hpp"

namespace strake::geometry {
namespace {

double squared(const Vec3d& v) { return dot(v, v); }

struct Nearest {
  double squared = std::numeric_limits<double>::infinity();
  double along = 0;
};

}  // namespace

std::optional<double> near_along(const Vec3d& from, const Vec3d& to, const Corners& t,
                                 double squared_reach) {
  if (squared_gap(box_of(std::array{from, to}), box_of(t)) > squared_reach) return std::nullopt;
  const Vec3d n = normal_of(t), d = to - from;
  const std::array<double, 2> height{dot(n, from - t[0]), dot(n, to - t[0])};
  if ((height[0] <= 0 && height[1] >= 0) || (height[0] >= 0 && height[1] <= 0)) {
    const double s = height[0] == height[1] ? 0 : height[0] / (height[0] - height[1]);
    if (stands_over(from + d * s, t, n)) return s;
  }
  Nearest best;
  // Of a segment without length only the ends count: what is no number is not less.
  const auto offer = [&](const Nearest& near) {
    if (near.squared < best.squared) best = near;
  };
  for (const double end : {0.0, 1.0}) {
    const Vec3d p = end > 0 ? to : from;
    offer({squared(p - nearest_on_triangle(p, t)), end});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d edge = t[(i + 1) % 3] - t[i];
    const auto [on_d, on_edge] = nearest_on_segments(from, d, t[i], edge);
    offer({squared(from - t[i] + d * on_d - edge * on_edge), on_d});
  }
  if (best.squared > squared_reach) return std::nullopt;
  return best.along;
}

}  // namespace strake::geometry
