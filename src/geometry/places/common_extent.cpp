// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/places/clip.hpp"
#include "geometry/range.hpp"
#include "geometry/tree_walk.hpp"
#include "strake/geometry/meeting_places.hpp"

namespace strake::geometry {
namespace {

/// Whether some of a box may lie in three slabs.
bool reaches_into(const Box3d& box, const std::array<Slab, 3>& room) {
  constexpr double kRounding = 1.0 / 1024;
  return std::ranges::all_of(room, [&](const Slab& slab) {
    const Range along = range_along(box, slab.axis);
    return along.lo <= slab.hi + kRounding && along.hi >= slab.lo - kRounding;
  });
}

/// What of a part's skin lies in the box along another's faces; `shift` takes the part's
/// coordinates to the other's. In the part's own coordinates.
Box3d skin_within(const FramedPart& framed, const PartFrame& of_other, const Vec3d& shift,
                  double reach) {
  const Part& part = *framed.placed.part;
  std::array<Slab, 3> room;
  for (std::size_t i = 0; i < 3; ++i) {
    const double base = dot(of_other.axis[i], shift);
    room[i] = {of_other.axis[i], of_other.lo[i] - reach - base, of_other.hi[i] + reach - base};
  }
  Box3d box = empty_box<double>();
  const auto add = [&](std::uint32_t t) {
    const Corners c = corners_of(part, t);
    bool adds = false;
    for (const Vec3d& p : c) adds = adds || !box.contains({p, p});
    if (adds) box.include(box_within(c, room));
    return true;
  };
  if (framed.tree != nullptr && part.vertices.size() >= kManyVertices &&
      !framed.tree->nodes().empty()) {
    walk_tree(
        *framed.tree,
        [&](const PartTree::Node& node) { return reaches_into(node.box.as<double>(), room); }, add);
  } else {
    for (std::uint32_t t = 0; t < part.triangles.size(); ++t) add(t);
  }
  return box;
}

}  // namespace

Box3d common_extent(const FramedPart& a, const FramedPart& b, double reach) {
  // The extreme points of the common part lie on the skin of one within the other.
  const double margin = reach + 1;
  const Vec3d shift = (b.placed.origin - a.placed.origin).as<double>();
  Box3d box = skin_within(a, *b.frame, -shift, margin);
  const Box3d of_b = skin_within(b, *a.frame, shift, margin);
  if (!of_b.empty()) box.include(of_b.moved(shift));
  return box;
}

}  // namespace strake::geometry
