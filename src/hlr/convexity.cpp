// SPDX-License-Identifier: Apache-2.0
#include "hlr/convexity.hpp"

#include <cmath>
#include <cstddef>

namespace strake::hlr {
namespace {

using geometry::Part;
using geometry::Triangle;
using geometry::Vec3d;
using geometry::Vec3i;
using geometry::Vec3l;

/// The ray from the middle, the sum of `count` points over their number, through the centre of
/// triangle 0: the triangle that it leaves by has the ray's direction inside the cone of its
/// corners.
bool ray_meets_once(const Part& part, const Vec3l& sum, std::int64_t count) {
  const Triangle& first = part.triangles[0];
  const auto from_middle = [&](std::uint32_t v) {
    const Vec3l q = part.vertices[v].as<std::int64_t>() * count - sum;
    return q.as<double>();
  };
  const Vec3d ray = from_middle(first[0]) + from_middle(first[1]) + from_middle(first[2]);
  std::size_t hits = 0;
  for (const Triangle& t : part.triangles) {
    const Vec3d a = from_middle(t[0]), b = from_middle(t[1]), c = from_middle(t[2]);
    // Doubt counts as a hit: the certificate is refused, never forged.
    const double size = (std::abs(ray.x) + std::abs(ray.y) + std::abs(ray.z)) * 1e-9;
    const auto within = [&](const Vec3d& p, const Vec3d& q) {
      const Vec3d n = cross(p, q);
      return dot(n, ray) >= -size * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    };
    if (within(a, b) && within(b, c) && within(c, a)) ++hits;
  }
  return hits == 1;
}

}  // namespace

bool bounds_convex_body(const Part& part, std::span<const TrianglePlane> planes) {
  Vec3l sum{0, 0, 0};
  for (const Vec3i& v : part.vertices) sum = sum + v.as<std::int64_t>();
  const auto count = static_cast<std::int64_t>(part.vertices.size());
  if (count < 4 || count > (1 << 20)) return false;
  // All heights are taken times the number of vertices, so that the middle is integer.
  const auto inside = [&](const std::array<std::int64_t, 3>& n, const Vec3i& v) {
    const Vec3l q = v.as<std::int64_t>() * count - sum;
    return static_cast<Int128>(n[0]) * q.x + static_cast<Int128>(n[1]) * q.y +
               static_cast<Int128>(n[2]) * q.z >
           0;
  };
  for (std::size_t t = 0; t < planes.size(); ++t)
    if (!inside(planes[t].n, part.vertices[part.triangles[t][0]])) return false;
  return ray_meets_once(part, sum, count);
}

}  // namespace strake::hlr
