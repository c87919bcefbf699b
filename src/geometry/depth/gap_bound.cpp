// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/depth/depth_field.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

/// Vertices visited at most for one side's normals: a look that costs more than this is no saving.
constexpr std::size_t kMaxVisits = 20'000;

/// The least n·v over the vertices of a part, in its own coordinates.
double least_along(const Part& part, const Vec3d& n) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3i& v : part.vertices)
    least = std::min(least, n.x * static_cast<double>(v.x) + n.y * static_cast<double>(v.y) +
                                n.z * static_cast<double>(v.z));
  return least;
}

/// The widest gap along the normals of `from`; `shift` takes `to` into its coordinates.
double widest_gap(const SupportPlanes& from, const Part& to, const Vec3d& shift, double rounding,
                  double enough) {
  const std::size_t most = kMaxVisits / std::max<std::size_t>(to.vertices.size(), 1);
  double widest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(most, from.planes.size()) && widest < enough; ++i) {
    const SupportPlanes::Plane& plane = from.planes[i];
    const double gap = least_along(to, plane.normal) + dot(plane.normal, shift) - plane.support;
    // Normals are unit vectors but for rounding.
    widest = std::max(widest, gap * (1 - 1e-14) - rounding);
  }
  return widest;
}

}  // namespace

double gap_bound(const DepthPart& a, const DepthPart& b, double enough) {
  const Part &x = *a.treed.placed.part, &y = *b.treed.placed.part;
  const Vec3d shift = (b.treed.placed.origin - a.treed.placed.origin).as<double>();
  double reach = std::fabs(shift.x) + std::fabs(shift.y) + std::fabs(shift.z);
  for (const Part* part : {&x, &y})
    for (int k = 0; k < 3; ++k)
      reach += std::fabs(static_cast<double>(part->box.lo[k])) +
               std::fabs(static_cast<double>(part->box.hi[k]));
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * reach;
  const double gap = widest_gap(*a.planes, y, shift, rounding, enough);
  if (gap >= enough) return gap;
  return std::max(gap, widest_gap(*b.planes, x, -shift, rounding, enough));
}

}  // namespace strake::geometry
