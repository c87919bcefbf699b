// SPDX-License-Identifier: Apache-2.0
#include "clash/volumes/volume_bracket.hpp"

#include <array>
#include <cstddef>
#include <numbers>

#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/part.hpp"

namespace strake::clash {
namespace {

using geometry::Box3d;
using geometry::Part;
using geometry::Vec3d;

/// A convex polygon; cutting a triangle at the six planes of a box leaves nine corners at most.
struct Polygon {
  std::array<Vec3d, 16> corners;
  std::size_t count = 0;

  void add(const Vec3d& corner) { corners[count++] = corner; }
};

/// Returns the part of a polygon in which sign * coordinate k is at most sign * limit.
Polygon cut(const Polygon& polygon, int k, double limit, double sign) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3d &p = polygon.corners[i], &q = polygon.corners[(i + 1) % polygon.count];
    const double at_p = sign * (p[k] - limit), at_q = sign * (q[k] - limit);
    if (at_p <= 0) kept.add(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
      kept.add(p + (q - p) * (at_p / (at_p - at_q)));
  }
  return kept;
}

/// Returns the volume within `off` of a convex polygon: a slab, half cylinders along its edges and
/// a ball in all at its corners.
double volume_within(double off, const Polygon& polygon) {
  Vec3d twice_area;
  double around = 0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3d &p = polygon.corners[i], &q = polygon.corners[(i + 1) % polygon.count];
    twice_area = twice_area + cross(p - polygon.corners.front(), q - polygon.corners.front());
    around += length(q - p);
  }
  return off * length(twice_area) + std::numbers::pi / 2 * off * off * around +
         4 * std::numbers::pi / 3 * off * off * off;
}

/// Returns the volume within `off` of a part's triangles, as far as these lie in a box relative to
/// its origin.
double skin_volume(const Part& part, double off, const Box3d& box) {
  double volume = 0;
  if (!(off > 0)) return volume;
  for (const geometry::Triangle& triangle : part.triangles) {
    Polygon polygon;
    for (const std::uint32_t v : triangle) polygon.add(part.vertices[v].as<double>());
    for (int k = 0; k < 3 && polygon.count > 0; ++k)
      polygon = cut(cut(polygon, k, box.lo[k], -1), k, box.hi[k], 1);
    if (polygon.count > 0) volume += volume_within(off, polygon);
  }
  return volume;
}

/// Returns how far a part's true surface may lie from its triangles.
double off_by(const ScenePart& part) {
  return part.placed.part->sag + static_cast<double>(part.snap) + static_cast<double>(part.step);
}

/// Returns the box of `other`, so much larger, relative to the origin of `part`.
Box3d box_beside(const ScenePart& part, const ScenePart& other, double margin) {
  const Vec3d shift = (other.placed.origin - part.placed.origin).as<double>();
  const auto& box = other.placed.part->box;
  const Vec3d around{margin, margin, margin};
  return {box.lo.as<double>() + shift - around, box.hi.as<double>() + shift + around};
}

}  // namespace

double volume_uncertainty(const ScenePart& a, const ScenePart& b) {
  const double off_a = off_by(a), off_b = off_by(b), margin = off_a + off_b;
  return skin_volume(*a.placed.part, off_a, box_beside(a, b, margin)) +
         skin_volume(*b.placed.part, off_b, box_beside(b, a, margin));
}

}  // namespace strake::clash
