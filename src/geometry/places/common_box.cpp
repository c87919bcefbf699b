// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/common_box.hpp"

#include <array>

#include "geometry/box.hpp"
#include "geometry/places/clip.hpp"

namespace strake::geometry {
namespace {

std::array<Slab, 3> slabs_of(const Box3d& box) {
  return {Slab{{1, 0, 0}, box.lo.x, box.hi.x}, Slab{{0, 1, 0}, box.lo.y, box.hi.y},
          Slab{{0, 0, 1}, box.lo.z, box.hi.z}};
}

}  // namespace

void include_common(const TriangleCorners& a, const TriangleCorners& b, double reach,
                    Box3d& extent) {
  const double margin = reach + kCutMargin;
  const Corners corners_a = as_doubles(a), corners_b = as_doubles(b);
  const Box3d box_a = box_of(corners_a), box_b = box_of(corners_b);
  const Box3d room_a = box_b.inflated(margin), room_b = box_a.inflated(margin);
  if (extent.contains(room_a.common(room_b))) return;
  const Box3d of_a = room_a.contains(box_a) ? box_a : box_within(corners_a, slabs_of(room_a));
  const Box3d of_b = room_b.contains(box_b) ? box_b : box_within(corners_b, slabs_of(room_b));
  const Box3d both = of_a.inflated(margin).common(of_b.inflated(margin));
  extent.include(both.empty() ? room_a.common(room_b) : both);
}

}  // namespace strake::geometry
