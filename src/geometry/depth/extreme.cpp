// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/extreme.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "geometry/pair_view.hpp"

namespace strake::geometry {
namespace {

/// Below this many vertices walking them all is quicker.
constexpr std::size_t kFew = 48;

constexpr double kNothing = -std::numeric_limits<double>::infinity();

double along(const Vec3d& n, const Vec3i& v) {
  return n.x * static_cast<double>(v.x) + n.y * static_cast<double>(v.y) +
         n.z * static_cast<double>(v.z);
}

/// No vertex in the box gives more: its far corner is summed in the same order, and rounding never
/// changes the order of two numbers.
double along(const Vec3d& n, const Box3i& box) {
  return along(n, Vec3i{n.x < 0 ? box.lo.x : box.hi.x, n.y < 0 ? box.lo.y : box.hi.y,
                        n.z < 0 ? box.lo.z : box.hi.z});
}

double by_tree(const Part& part, const PartTree& tree, const Vec3d& n) {
  const auto& nodes = tree.nodes();
  double best = kNothing;
  std::array<std::pair<std::uint32_t, double>, kMaxTreeDepth + 2> stack;
  std::size_t size = 0;
  stack[size++] = {0, along(n, nodes.front().box)};
  while (size > 0) {
    const auto [index, most] = stack[--size];
    if (!(most > best)) continue;
    const PartTree::Node& node = nodes[index];
    if (node.count == 0) {
      std::pair near{node.first, along(n, nodes[node.first].box)};
      std::pair far{node.first + 1, along(n, nodes[node.first + 1].box)};
      if (far.second > near.second) std::swap(near, far);
      stack[size++] = far;
      stack[size++] = near;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      for (const std::uint32_t v : part.triangles[tree.order()[i]])
        best = std::max(best, along(n, part.vertices[v]));
  }
  return best;
}

}  // namespace

double greatest_along(const Part& part, const PartTree* tree, const Vec3d& n) {
  if (tree != nullptr && part.vertices.size() > kFew && !tree->nodes().empty())
    return by_tree(part, *tree, n);
  double best = kNothing;
  for (const Vec3i& v : part.vertices) best = std::max(best, along(n, v));
  return best;
}

}  // namespace strake::geometry
