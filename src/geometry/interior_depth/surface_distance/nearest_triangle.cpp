// SPDX-License-Identifier: Apache-2.0
#include "geometry/interior_depth/surface_distance/nearest_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

/// A triangle whose height is less than this relative to its longest edge has no sides to speak of.
constexpr double kSliver = 1e-6;
/// Grid units: a point so far inside of a side may be outside of it.
constexpr double kBeside = 1e-3;
/// Relative, and grid units squared: far above what a height is off by.
constexpr double kNearestRounding = 1e-3;

/// Depth-first, nearer child first; equal distances keep the lower triangle, so that neither the
/// hint nor the tree's shape shows in the answer.
class NearestTriangleSearch {
 public:
  NearestTriangleSearch(const SurfaceBvh& surface, const Vec3d& p)
      : surface_(surface),
        tree_(surface.frame == nullptr ? surface.tree : surface.frame->part.tree),
        p_(p),
        in_tree_(surface.frame == nullptr ? p : turned(surface.frame->axes, p)) {}

  NearestTriangle run(std::uint32_t hint, double limit) {
    shrink(limit * limit);
    if (hint != kNoIndex) test(hint);
    if (!tree_.nodes().empty()) descend(0, gap(0));
    NearestTriangle found{.visited = visited_};
    if (triangle_ != kNoIndex) {
      found.distance = std::sqrt(best_);
      found.triangle = triangle_;
    }
    return found;
  }

 private:
  void test(std::uint32_t t) {
    if (!surface_.prepared.empty()) {
      const PreparedTriangle& at = surface_.prepared[t];
      if (!is_farther_along(at.unit, 1, at.lo, at.hi)) compare(t, at.nearest(p_));
      return;
    }
    const Corners c = corners_of(surface_.part, t);
    const Vec3d n = normal_of(c);
    const double x = dot(n, c[0]), y = dot(n, c[1]), z = dot(n, c[2]);
    if (!is_farther_along(n, squared_length(n), std::min({x, y, z}), std::max({x, y, z})))
      compare(t, nearest_on_triangle(p_, c));
  }

  /// Whether a triangle, from `lo` to `hi` along a vector of that length squared, is farther than
  /// the nearest by that alone, whatever the rounding.
  [[nodiscard]] bool is_farther_along(const Vec3d& n, double length_squared, double lo,
                                      double hi) const {
    const double along = dot(n, p_), gap = std::max({along - hi, lo - along, 0.0});
    return gap * gap > (best_ * (1 + kNearestRounding) + kNearestRounding) * length_squared;
  }

  void compare(std::uint32_t t, const Vec3d& nearest) {
    const double d = squared_length(nearest - p_);
    if (d < best_ || (d == best_ && t < triangle_)) {
      shrink(d);
      triangle_ = t;
    }
  }

  /// Nothing farther is of interest.
  void shrink(double squared_distance) {
    best_ = reach_ = squared_distance;
    if (surface_.frame == nullptr) return;
    const double off = std::sqrt(best_) + kRotationRounding + kFrameRounding;
    reach_ = off * off;
  }

  [[nodiscard]] double gap(std::uint32_t index) const {
    return squared_gap(in_tree_, tree_.nodes()[index].box.as<double>());
  }

  void descend(std::uint32_t index, double at) {
    if (at > reach_) return;
    ++visited_;
    const TriangleBvh::Node& node = tree_.nodes()[index];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) test(tree_.order()[i]);
      return;
    }
    const double left = gap(node.first), right = gap(node.first + 1);
    if (left <= right) {
      descend(node.first, left);
      descend(node.first + 1, right);
    } else {
      descend(node.first + 1, right);
      descend(node.first, left);
    }
  }

  const SurfaceBvh& surface_;
  const TriangleBvh& tree_;
  Vec3d p_, in_tree_;
  double best_ = 0, reach_ = 0;  ///< squared; of triangles, of boxes
  std::uint32_t triangle_ = kNoIndex, visited_ = 0;
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
  if (projects_inside(p, t, normal) && dot(normal, normal) > 0)
    return p - normal * (dot(p - t[0], normal) / dot(normal, normal));
  Vec3d best = nearest_on_segment(p, t[0], t[1]);
  for (std::size_t i = 1; i < 3; ++i) {
    const Vec3d q = nearest_on_segment(p, t[i], t[(i + 1) % 3]);
    if (squared_length(q - p) < squared_length(best - p)) best = q;
  }
  return best;
}

PreparedTriangle::PreparedTriangle(const Corners& c) : corners(c) {
  const Vec3d n = normal_of(c);
  size = length(n);
  if (!(size > 0)) return;
  unit = n * (1 / size);
  const double x = dot(unit, c[0]), y = dot(unit, c[1]), z = dot(unit, c[2]);
  lo = std::min({x, y, z});
  hi = std::max({x, y, z});
  const Vec3d longest = longest_edge(c);
  if (size < kSliver * squared_length(longest)) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d side = cross(unit, c[(i + 1) % 3] - c[i]);
    inwards[i] = side * (1 / length(side));
  }
}

Vec3d PreparedTriangle::nearest(const Vec3d& p) const {
  if (!(squared_length(inwards[0]) > 0)) return nearest_on_triangle(p, corners);
  bool over = true;
  Vec3d best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const double in = dot(inwards[i], p - corners[i]);
    if (in > kBeside) continue;
    over = over && in >= 0;
    const Vec3d q = nearest_on_segment(p, corners[i], corners[(i + 1) % 3]);
    const double d = squared_length(q - p);
    if (!(d < least)) continue;
    least = d;
    best = q;
  }
  return over ? p - unit * dot(unit, p - corners[0]) : best;
}

NearestTriangle nearest_triangle(const SurfaceBvh& surface, const Vec3d& p, std::uint32_t hint,
                                 double limit) {
  return NearestTriangleSearch(surface, p).run(hint, limit);
}

double distance_upper_bound(const SurfaceBvh& surface, const Vec3d& p) {
  const TriangleBvh& tree = surface.frame == nullptr ? surface.tree : surface.frame->part.tree;
  const Vec3d in_tree = surface.frame == nullptr ? p : turned(surface.frame->axes, p);
  double least = std::numeric_limits<double>::infinity();
  if (tree.nodes().empty()) return least;
  const TriangleBvh::Node* node = tree.nodes().data();
  const auto gap = [&](std::uint32_t index) {
    return squared_gap(in_tree, tree.nodes()[index].box.as<double>());
  };
  while (node->count == 0)
    node = &tree.nodes()[node->first + (gap(node->first + 1) < gap(node->first) ? 1 : 0)];
  for (std::uint32_t i = node->first; i < node->first + node->count; ++i)
    least = std::min(
        least,
        squared_length(nearest_on_triangle(p, corners_of(surface.part, tree.order()[i])) - p));
  return std::sqrt(least);
}

SurfacePoint nearest_on_surface(const PartWithBvh& part, const Vec3d& p) {
  const NearestTriangle nearest = nearest_triangle({*part.placed.part, *part.tree}, p);
  if (nearest.triangle == kNoIndex) return {p, 0, {}, kNoIndex};
  const Corners c = corners_of(*part.placed.part, nearest.triangle);
  const Vec3d n = normal_of(c);
  return {nearest_on_triangle(p, c), nearest.distance, n * (1 / length(n)), nearest.triangle};
}

}  // namespace strake::geometry
