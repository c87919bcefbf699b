// SPDX-License-Identifier: Apache-2.0
#include "geometry/contact_regions/overlap_extent.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/bvh/traversal.hpp"
#include "geometry/contact_regions/contact_regions.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

std::array<Slab, 3> slabs_of(const Box3d& box) {
  return {Slab{{1, 0, 0}, box.lo.x, box.hi.x}, Slab{{0, 1, 0}, box.lo.y, box.hi.y},
          Slab{{0, 0, 1}, box.lo.z, box.hi.z}};
}

}  // namespace

void include_overlap(const TriangleCorners& a, const TriangleCorners& b, double reach,
                     Box3d& extent) {
  const double margin = reach + kCutMargin;
  const Corners corners_a = as_doubles(a), corners_b = as_doubles(b);
  const Box3d box_a = box_of(corners_a), box_b = box_of(corners_b);
  const Box3d room_a = box_b.inflated(margin), room_b = box_a.inflated(margin);
  if (extent.contains(room_a.common(room_b))) return;
  const Box3d of_a = room_a.contains(box_a) ? box_a : box_of_clipped(corners_a, slabs_of(room_a));
  const Box3d of_b = room_b.contains(box_b) ? box_b : box_of_clipped(corners_b, slabs_of(room_b));
  const Box3d both = of_a.inflated(margin).common(of_b.inflated(margin));
  extent.include(both.empty() ? room_a.common(room_b) : both);
}

namespace {

/// Whether some of a box may lie in three slabs.
bool reaches_into(const Box3d& box, const std::array<Slab, 3>& slabs) {
  constexpr double kRounding = 1.0 / 1024;
  return std::ranges::all_of(slabs, [&](const Slab& slab) {
    const ProjectionInterval along = range_along(box, slab.axis);
    return along.lo <= slab.hi + kRounding && along.hi >= slab.lo - kRounding;
  });
}

/// Returns the box of the part's surface within the other's oriented box, in the part's own
/// coordinates; `shift` takes these to the other's.
Box3d surface_extent_within(const PartWithObb& framed, const OrientedBox& of_other,
                            const Vec3d& shift, double reach) {
  const Part& part = *framed.placed.part;
  std::array<Slab, 3> slabs;
  for (std::size_t i = 0; i < 3; ++i) {
    const double base = dot(of_other.axis[i], shift);
    slabs[i] = {of_other.axis[i], of_other.lo[i] - reach - base, of_other.hi[i] + reach - base};
  }
  Box3d box = empty_box<double>();
  const auto add = [&](std::uint32_t t) {
    const Corners c = corners_of(part, t);
    bool adds = false;
    for (const Vec3d& p : c) adds = adds || !box.contains({p, p});
    if (adds) box.include(box_of_clipped(c, slabs));
    return true;
  };
  if (framed.tree != nullptr && part.vertices.size() >= kManyVertices &&
      !framed.tree->nodes().empty()) {
    traverse_bvh(
        *framed.tree,
        [&](const TriangleBvh::Node& node) { return reaches_into(node.box.as<double>(), slabs); },
        add);
  } else {
    for (std::uint32_t t = 0; t < part.triangles.size(); ++t) add(t);
  }
  return box;
}

}  // namespace

Box3d overlap_extent(const PartWithObb& a, const PartWithObb& b, double reach) {
  // The extreme points of the intersection lie on the surface of one within the other.
  const double margin = reach + 1;
  const Vec3d shift = (b.placed.origin - a.placed.origin).as<double>();
  Box3d box = surface_extent_within(a, *b.frame, -shift, margin);
  const Box3d of_b = surface_extent_within(b, *a.frame, shift, margin);
  if (!of_b.empty()) box.include(of_b.moved(shift));
  return box;
}

}  // namespace strake::geometry
