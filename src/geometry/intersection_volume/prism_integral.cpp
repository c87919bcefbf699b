// SPDX-License-Identifier: Apache-2.0
#include "geometry/intersection_volume/prism_integral.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "strake/geometry/wide_int.hpp"

namespace strake::geometry {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// Three corners, three cuts by the other's edges and two by heights make eight, each cut adding
/// one; the rest is for polygons that rounding leaves convex to within an ulp only.
constexpr std::size_t kMaxCorners = 12;

/// A corner of the common part of two projections, with the heights of both planes above it.
struct PrismCorner {
  double x = 0, y = 0;
  double za = 0, zb = 0;
};

struct PrismBase {
  std::array<PrismCorner, kMaxCorners> corner;
  std::size_t size = 0;
  void add(const PrismCorner& c) { corner[size++] = c; }
};

PrismCorner between(const PrismCorner& p, const PrismCorner& q, double t) {
  return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.za + t * (q.za - p.za),
          p.zb + t * (q.zb - p.zb)};
}

/// Returns the part of a convex polygon where `height` is not negative.
template <class Height>
PrismBase cut(const PrismBase& polygon, Height&& height) {
  std::array<double, kMaxCorners> at{};
  bool all = true, none = true;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    at[i] = height(polygon.corner[i]);
    all = all && at[i] >= 0;
    none = none && at[i] <= 0;
  }
  if (all) return polygon;
  PrismBase kept;
  if (none) return kept;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const std::size_t next = i + 1 == polygon.size ? 0 : i + 1;
    const PrismCorner &p = polygon.corner[i], &q = polygon.corner[next];
    if (at[i] >= 0) kept.add(p);
    const bool crosses = (at[i] > 0 && at[next] < 0) || (at[i] < 0 && at[next] > 0);
    if (crosses && kept.size < kMaxCorners) kept.add(between(p, q, at[i] / (at[i] - at[next])));
    if (kept.size == kMaxCorners) break;
  }
  return kept;
}

double height_of(const ProjectedTriangle& f, double x, double y) {
  const double z =
      f.corner[0].z + f.slope_x * (x - f.corner[0].x) + f.slope_y * (y - f.corner[0].y);
  return std::clamp(z, f.lo.z, f.hi.z);
}

/// Projections of both, with the heights of both planes.
PrismBase common_projection(const ProjectedTriangle& a, const ProjectedTriangle& b) {
  PrismBase polygon;
  for (const Vec3d& c : a.corner) polygon.add({c.x, c.y, c.z, 0});
  for (std::size_t i = 0; i < 3 && polygon.size > 0; ++i) {
    const Vec3d &from = b.corner[i], &to = b.corner[i == 2 ? 0 : i + 1];
    const double ex = to.x - from.x, ey = to.y - from.y;
    polygon = cut(polygon,
                  [&](const PrismCorner& c) { return ex * (c.y - from.y) - ey * (c.x - from.x); });
  }
  for (std::size_t i = 0; i < polygon.size; ++i)
    polygon.corner[i].zb = height_of(b, polygon.corner[i].x, polygon.corner[i].y);
  return polygon;
}

template <class Height>
double integral(const PrismBase& polygon, Height&& height) {
  double sum = 0;
  const auto& c = polygon.corner;
  for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
    const double twice =
        (c[i].x - c[0].x) * (c[i + 1].y - c[0].y) - (c[i].y - c[0].y) * (c[i + 1].x - c[0].x);
    sum += twice / 6 * (height(c[0]) + height(c[i]) + height(c[i + 1]));
  }
  return sum;
}

/// A cut by an edge misplaces it by a few ulp of the distances involved, along no more than the
/// diagonal of the common part; heights are off by what that does on the slopes. The factors are
/// those of the operations above, doubled and more.
double error_of(const ProjectedTriangle& a, const ProjectedTriangle& b, double area) {
  const double extent = std::max(a.hi.x, b.hi.x) - std::min(a.lo.x, b.lo.x) +
                        std::max(a.hi.y, b.hi.y) - std::min(a.lo.y, b.lo.y);
  const double diagonal = std::min(a.hi.x, b.hi.x) - std::max(a.lo.x, b.lo.x) +
                          std::min(a.hi.y, b.hi.y) - std::max(a.lo.y, b.lo.y);
  const double top = std::min(a.hi.z, b.hi.z);
  const double size = std::max({a.hi.z, b.hi.z, -a.lo.z, -b.lo.z});
  const double slopes =
      std::fabs(a.slope_x) + std::fabs(a.slope_y) + std::fabs(b.slope_x) + std::fabs(b.slope_y);
  const double heights = std::min(2 * top, 32 * kEps * (slopes * extent + size));
  const double areas = 256 * kEps * extent * (diagonal + 1);
  return (area + areas) * heights + areas * top;
}

}  // namespace

ProjectedTriangle::ProjectedTriangle(const std::array<Vec3l, 3>& corners) {
  const Vec3l u = corners[1] - corners[0], v = corners[2] - corners[0];
  const Vec3<Int128> n = cross(u.as<Int128>(), v.as<Int128>());
  sign = static_cast<double>((n.z > 0) - (n.z < 0));
  if (sign == 0) return;
  slope_x = -static_cast<double>(n.x) / static_cast<double>(n.z);
  slope_y = -static_cast<double>(n.y) / static_cast<double>(n.z);
  for (std::size_t i = 0; i < 3; ++i) corner[i] = corners[i].as<double>();
  if (sign < 0) std::swap(corner[1], corner[2]);
  lo = hi = corner[0];
  for (const Vec3d& c : corner)
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], c[k]);
      hi[k] = std::max(hi[k], c[k]);
    }
}

PrismIntegral prism_integral(const ProjectedTriangle& a, const ProjectedTriangle& b) {
  const PrismBase common = common_projection(a, b);
  const PrismBase a_lower = cut(common, [](const PrismCorner& c) { return c.zb - c.za; });
  const PrismBase b_lower = cut(common, [](const PrismCorner& c) { return c.za - c.zb; });
  const auto za = [](const PrismCorner& c) { return c.za; };
  const auto zb = [](const PrismCorner& c) { return c.zb; };
  double value = integral(a.lo.z < 0 ? cut(a_lower, za) : a_lower, za);
  // A polygon in which the planes agree everywhere is whole on both sides of the cut.
  bool equal = true;
  for (std::size_t i = 0; i < common.size && equal; ++i)
    equal = common.corner[i].za == common.corner[i].zb;
  if (!equal) value += integral(b.lo.z < 0 ? cut(b_lower, zb) : b_lower, zb);
  return {value, error_of(a, b, integral(common, [](const PrismCorner&) { return 1.0; }))};
}

}  // namespace strake::geometry
