// SPDX-License-Identifier: Apache-2.0
#include "geometry/plane_sides.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/tree_walk.hpp"

namespace strake::geometry {
namespace {

/// Parts with fewer vertices are tested one by one: cheaper than walking the tree.
constexpr std::size_t kFewVertices = 48;

Vec3d absolute(const Vec3d& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }
double largest(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }

class SideWalk {
 public:
  /// side: -1 or 1; strict: points of the plane count as on the wrong side.
  SideWalk(const ExactTriangle& t, int side, bool strict)
      : plane_(t.plane), side_(side), least_(strict ? 1 : 0) {
    anchor_ = t.corner[0].as<double>();
    // Rounding of the normal and of a product with it: below 64 roundings of |u||v| a component.
    slack_ = 0x1p-47 * largest(absolute((t.corner[1] - t.corner[0]).as<double>())) *
             largest(absolute((t.corner[2] - t.corner[0]).as<double>()));
  }

  /// False at the first vertex on the wrong side.
  [[nodiscard]] bool all_on_side(const PartView& view);
  [[nodiscard]] bool leaves_plane() const { return leaves_plane_; }

 private:
  [[nodiscard]] bool accept(const Vec3l& p) {
    const int side = plane_.side(p) * side_;
    leaves_plane_ |= side > 0;
    return side >= least_;
  }
  /// Certain that all of the box lies strictly on the wanted side.
  [[nodiscard]] bool clear(const Box3l& box) const {
    const Vec3d centre = (box.lo + box.hi).as<double>() * 0.5 - anchor_;
    const Vec3d half = (box.hi - box.lo).as<double>() * 0.5;
    const Vec3d& n = plane_.normal();
    const double reach = dot(absolute(n), half) + slack_ * largest(absolute(centre) + half);
    return dot(n, centre) * side_ > reach;
  }
  [[nodiscard]] bool walk(const PartView& view);

  const ExactPlane& plane_;
  Vec3d anchor_;
  double slack_ = 0;
  int side_, least_;
  bool leaves_plane_ = false;
};

bool SideWalk::all_on_side(const PartView& view) {
  const std::vector<Vec3i>& vertices = view.part().vertices;
  if (vertices.size() > kFewVertices) return walk(view);
  return std::ranges::all_of(
      vertices, [&](const Vec3i& v) { return accept(v.as<std::int64_t>() + view.shift()); });
}

bool SideWalk::walk(const PartView& view) {
  return walk_tree(
      view.tree(),
      [&](const PartTree::Node& node) {
        const bool all_beyond = clear(view.box(node.box));
        leaves_plane_ |= all_beyond;
        return !all_beyond;
      },
      [&](std::uint32_t triangle) {
        return std::ranges::all_of(view.corners(triangle),
                                   [&](const Vec3l& p) { return accept(p); });
      });
}

bool keeps_to(const ExactTriangle& triangle, int side, const PartView& view) {
  SideWalk walk(triangle, side, false);
  return walk.all_on_side(view) && (view.solid() || walk.leaves_plane());
}

}  // namespace

bool separates(const ExactTriangle& triangle, const PartView& below, const PartView& above) {
  return keeps_to(triangle, -1, below) && keeps_to(triangle, 1, above);
}

bool parts_strictly(const ExactTriangle& triangle, const PartView& below, const PartView& above) {
  return SideWalk(triangle, 1, true).all_on_side(above) &&
         SideWalk(triangle, -1, false).all_on_side(below);
}

}  // namespace strake::geometry
