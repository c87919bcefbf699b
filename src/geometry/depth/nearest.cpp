// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/nearest.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/box.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

double squared(const Vec3d& v) { return dot(v, v); }

/// Relative, and grid units squared: far above what a height is off by.
constexpr double kRounding = 1e-3;

/// Depth-first, nearer child first; equal distances keep the lower triangle, so that neither the
/// hint nor the tree's shape shows in the answer.
class Search {
 public:
  Search(const Part& part, const PartTree& tree, const Vec3d& p,
         std::span<const PreparedTriangle> prepared)
      : part_(part), tree_(tree), p_(p), prepared_(prepared) {}

  NearestTriangle run(std::uint32_t hint, double limit) {
    best_ = limit * limit;
    if (hint != kNoFace) test(hint);
    if (!tree_.nodes().empty()) descend(0, squared_gap(p_, tree_.nodes()[0].box.as<double>()));
    NearestTriangle found{.visited = visited_};
    if (triangle_ != kNoFace) {
      found.distance = std::sqrt(best_);
      found.triangle = triangle_;
    }
    return found;
  }

 private:
  void test(std::uint32_t t) {
    if (!prepared_.empty()) {
      const PreparedTriangle& at = prepared_[t];
      if (!is_farther_along(at.unit, 1, at.lo, at.hi)) compare(t, at.corners);
      return;
    }
    const Corners c = corners_of(part_, t);
    const Vec3d n = normal_of(c);
    const double x = dot(n, c[0]), y = dot(n, c[1]), z = dot(n, c[2]);
    if (!is_farther_along(n, squared(n), std::min({x, y, z}), std::max({x, y, z}))) compare(t, c);
  }

  /// Whether a triangle, from `lo` to `hi` along a vector of that length squared, is farther than
  /// the nearest by that alone, whatever the rounding.
  [[nodiscard]] bool is_farther_along(const Vec3d& n, double length_squared, double lo,
                                      double hi) const {
    const double along = dot(n, p_), gap = std::max({along - hi, lo - along, 0.0});
    return gap * gap > (best_ * (1 + kRounding) + kRounding) * length_squared;
  }

  void compare(std::uint32_t t, const Corners& corners) {
    const double d = squared(nearest_on_triangle(p_, corners) - p_);
    if (d < best_ || (d == best_ && t < triangle_)) {
      best_ = d;
      triangle_ = t;
    }
  }

  void descend(std::uint32_t index, double at) {
    if (at > best_) return;
    ++visited_;
    const PartTree::Node& node = tree_.nodes()[index];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) test(tree_.order()[i]);
      return;
    }
    const double left = squared_gap(p_, tree_.nodes()[node.first].box.as<double>());
    const double right = squared_gap(p_, tree_.nodes()[node.first + 1].box.as<double>());
    if (left <= right) {
      descend(node.first, left);
      descend(node.first + 1, right);
    } else {
      descend(node.first + 1, right);
      descend(node.first, left);
    }
  }

  const Part& part_;
  const PartTree& tree_;
  Vec3d p_;
  std::span<const PreparedTriangle> prepared_;
  double best_ = 0;
  std::uint32_t triangle_ = kNoFace, visited_ = 0;
};

}  // namespace

Vec3d nearest_on_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d ab = b - a;
  const double t = dot(p - a, ab), n = dot(ab, ab);
  if (!(t > 0)) return a;
  if (!(t < n)) return b;
  return a + ab * (t / n);
}

Vec3d nearest_on_triangle(const Vec3d& p, const Corners& t) {
  const Vec3d normal = normal_of(t);
  if (stands_over(p, t, normal) && dot(normal, normal) > 0)
    return p - normal * (dot(p - t[0], normal) / dot(normal, normal));
  Vec3d best = nearest_on_segment(p, t[0], t[1]);
  for (std::size_t i = 1; i < 3; ++i) {
    const Vec3d q = nearest_on_segment(p, t[i], t[(i + 1) % 3]);
    if (squared(q - p) < squared(best - p)) best = q;
  }
  return best;
}

NearestTriangle nearest_triangle(const Part& part, const PartTree& tree, const Vec3d& p,
                                 std::uint32_t hint, double limit,
                                 std::span<const PreparedTriangle> prepared) {
  return Search(part, tree, p, prepared).run(hint, limit);
}

double some_distance(const Part& part, const PartTree& tree, const Vec3d& p) {
  double least = std::numeric_limits<double>::infinity();
  if (tree.nodes().empty()) return least;
  const PartTree::Node* node = tree.nodes().data();
  const auto gap = [&](std::uint32_t index) {
    return squared_gap(p, tree.nodes()[index].box.as<double>());
  };
  while (node->count == 0)
    node = &tree.nodes()[node->first + (gap(node->first + 1) < gap(node->first) ? 1 : 0)];
  for (std::uint32_t i = node->first; i < node->first + node->count; ++i)
    least = std::min(least, squared(nearest_on_triangle(p, corners_of(part, tree.order()[i])) - p));
  return std::sqrt(least);
}

SkinPoint nearest_on_skin(const TreedPart& part, const Vec3d& p) {
  const NearestTriangle nearest = nearest_triangle(*part.placed.part, *part.tree, p);
  if (nearest.triangle == kNoFace) return {p, 0, {}, kNoFace};
  const Corners c = corners_of(*part.placed.part, nearest.triangle);
  const Vec3d n = normal_of(c);
  return {nearest_on_triangle(p, c), nearest.distance, n * (1 / length(n)), nearest.triangle};
}

}  // namespace strake::geometry
