// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

/// The widest gap along the normals of `from`; `shift` takes `to` into its coordinates.
double widest_gap(const SupportPlanes& from, const VertexTree& to, const Vec3d& shift,
                  double rounding) {
  double widest = -std::numeric_limits<double>::infinity();
  if (to.empty()) return widest;
  // The vertex that came nearest last: most normals are done with at a look at it.
  Vec3d vertex = to.greatest_along({0, 0, 1}).vertex.as<double>();
  for (const SupportPlanes::Plane& plane : from.planes) {
    const double base = dot(plane.normal, shift) - plane.support;
    // Normals are unit vectors but for rounding.
    const auto certain = [&](double least) { return (least + base) * (1 - 1e-14) - rounding; };
    if (certain(dot(plane.normal, vertex)) <= widest) continue;
    const VertexTree::Extreme nearest = to.greatest_along(-plane.normal);
    vertex = nearest.vertex.as<double>();
    widest = std::max(widest, certain(-nearest.value));
  }
  return widest;
}

}  // namespace

double gap_bound(const DepthPart& a, const DepthPart& b) {
  const Part &x = *a.treed.placed.part, &y = *b.treed.placed.part;
  const Vec3d shift = (b.treed.placed.origin - a.treed.placed.origin).as<double>();
  double reach = std::fabs(shift.x) + std::fabs(shift.y) + std::fabs(shift.z);
  for (const Part* part : {&x, &y})
    for (int k = 0; k < 3; ++k)
      reach += std::fabs(static_cast<double>(part->box.lo[k])) +
               std::fabs(static_cast<double>(part->box.hi[k]));
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * reach;
  return std::max(widest_gap(*a.planes, b.planes->vertices, shift, rounding),
                  widest_gap(*b.planes, a.planes->vertices, -shift, rounding));
}

}  // namespace strake::geometry
