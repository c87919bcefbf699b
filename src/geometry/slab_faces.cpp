// SPDX-License-Identifier: Apache-2.0
#include "geometry/slab_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/tree_walk.hpp"

namespace strake::geometry {
namespace {

/// Grid units: how rough the snap may leave a flat face that stands askew.
constexpr double kRough = 4;

double height(const Vec3d& n, const Vec3l& v) { return dot(n, v.as<double>()); }

/// Of the lowest corner: summed in the same order, and rounding never changes the order of two
/// numbers.
double height(const Vec3d& n, const Box3l& box) {
  return height(n, Vec3l{n.x < 0 ? box.hi.x : box.lo.x, n.y < 0 ? box.hi.y : box.lo.y,
                         n.z < 0 ? box.hi.z : box.lo.z});
}

double height(const Vec3d& n, const PartView& view, std::uint32_t triangle) {
  const auto corners = view.corners(triangle);
  return std::min({height(n, corners[0]), height(n, corners[1]), height(n, corners[2])});
}

/// What of a part is lowest along a direction.
struct LowEnd {
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::uint32_t> triangles;  ///< those that come within kRough of it
};

std::optional<LowEnd> low_end(const PartView& view, const Vec3d& n, std::size_t most) {
  LowEnd end;
  const auto& nodes = view.tree().nodes();
  walk_nearer_first(
      view.tree(), [&](std::uint32_t i) { return height(n, view.box(nodes[i].box)); },
      [&](double lowest) { return lowest >= end.least; },
      [&](std::uint32_t t) { end.least = std::min(end.least, height(n, view, t)); });
  const double level = end.least + kRough;
  const bool all = walk_tree(
      view.tree(),
      [&](const PartTree::Node& node) { return height(n, view.box(node.box)) <= level; },
      [&](std::uint32_t t) {
        if (height(n, view, t) <= level) end.triangles.push_back(t);
        return end.triangles.size() <= most;
      });
  if (!all) return std::nullopt;
  return end;
}

double reach_of(const PartView& view) {
  const Box3l box = view.box(view.part().box);
  double reach = 0;
  for (int k = 0; k < 3; ++k)
    reach += std::max(std::fabs(static_cast<double>(box.lo[k])),
                      std::fabs(static_cast<double>(box.hi[k])));
  return reach;
}

}  // namespace

std::optional<SlabFaces> slab_faces(const PartView& a, const PartView& b, const Vec3d& normal,
                                    std::size_t most) {
  auto above = low_end(a, normal, most);
  if (!above) return std::nullopt;
  auto below = low_end(b, -normal, most);
  if (!below) return std::nullopt;
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * (reach_of(a) + reach_of(b));
  const double apart = above->least + below->least + kRough;
  return SlabFaces{std::move(above->triangles), std::move(below->triangles),
                   apart * (1 - 1e-14) - rounding};
}

}  // namespace strake::geometry
