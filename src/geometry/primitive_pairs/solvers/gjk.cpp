// SPDX-License-Identifier: Apache-2.0
#include "geometry/primitive_pairs/solvers/gjk.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace strake::geometry::primitive_pairs {
namespace {

/// Of 100,000 seeded pairs of convex primitives, apart or meeting, 99.9 % get a bracket within
/// 0.04 µm to either side; the widest seen is 1.1 µm (decision 0008).
constexpr int kMaxIterations = 96;
/// Grid units: a convex combination nearer than this to the origin needs no better one.
constexpr double kGjkTouch = 1e-3;

/// A point of a - b and the one of a that it came from.
struct MinkowskiDifference {
  Vec3d w, on_a;
};

/// Up to four differences, and the weights of their convex combination nearest to the origin.
class GjkSimplex {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool holds(const Vec3d& w) const {
    for (std::size_t i = 0; i < size_; ++i)
      if (points_[i].w == w) return true;
    return false;
  }

  void add(const MinkowskiDifference& d) { points_[size_++] = d; }

  /// Keeps the points that the nearest combination needs, and returns that combination.
  Vec3d reduce() {
    if (size_ == 1) set({0}, {1});
    if (size_ == 2) segment(0, 1);
    if (size_ == 3) triangle(0, 1, 2);
    if (size_ == 4) tetrahedron();
    compact();
    return mixture(&MinkowskiDifference::w);
  }

  [[nodiscard]] Vec3d mixture(Vec3d MinkowskiDifference::* part) const {
    Vec3d sum;
    for (std::size_t i = 0; i < size_; ++i) sum = sum + points_[i].*part * weights_[i];
    return sum;
  }

 private:
  struct Choice {
    std::array<std::size_t, 4> index{};
    std::array<double, 4> weight{};
    std::size_t count = 0;
  };

  void set(std::initializer_list<std::size_t> index, std::initializer_list<double> weight) {
    choice_.count = index.size();
    std::copy(index.begin(), index.end(), choice_.index.begin());
    std::copy(weight.begin(), weight.end(), choice_.weight.begin());
  }

  void segment(std::size_t i, std::size_t j) {
    const Vec3d &a = points_[i].w, ab = points_[j].w - a;
    const double square = dot(ab, ab), t = -dot(a, ab);
    if (!(t > 0)) return set({i}, {1});
    if (!(t < square)) return set({j}, {1});
    set({i, j}, {1 - t / square, t / square});
  }

  /// By the regions of the corners, the edges and the face (C. Ericson, Real-Time Collision
  /// Detection, 2005, 5.1.5).
  void triangle(std::size_t i, std::size_t j, std::size_t k) {
    const Vec3d &a = points_[i].w, &b = points_[j].w, &c = points_[k].w;
    const Vec3d ab = b - a, ac = c - a, n = cross(ab, ac);
    const double d1 = -dot(ab, a), d2 = -dot(ac, a);
    if (d1 <= 0 && d2 <= 0) return set({i}, {1});
    const double d3 = -dot(ab, b), d4 = -dot(ac, b);
    if (d3 >= 0 && d4 <= d3) return set({j}, {1});
    const double vc = dot(n, cross(a, b));
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return segment(i, j);
    const double d5 = -dot(ab, c), d6 = -dot(ac, c);
    if (d6 >= 0 && d5 <= d6) return set({k}, {1});
    const double vb = dot(n, cross(c, a));
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return segment(i, k);
    const double va = dot(n, cross(b, c));
    if (va <= 0 && d4 >= d3 && d5 >= d6) return segment(j, k);
    const double sum = va + vb + vc;
    if (!(sum > 0)) return segment(i, j);
    set({i, j, k}, {va / sum, vb / sum, vc / sum});
  }

  [[nodiscard]] double squared() const {
    Vec3d sum;
    for (std::size_t i = 0; i < choice_.count; ++i)
      sum = sum + points_[choice_.index[i]].w * choice_.weight[i];
    return dot(sum, sum);
  }

  /// The nearest of the faces that the origin lies beyond; or all four points, weighted by the
  /// volumes opposite to them, when that gives a nearer mixture, as it does when it lies beyond
  /// none. Slivers deceive the signs, so all are tried when the volumes fail.
  void tetrahedron() {
    static constexpr std::array<std::array<std::size_t, 4>, 4> kFaces{
        {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
    std::array<double, 4> weights{};
    std::array<bool, 4> beyond{};
    double sum = 0;
    bool within = true;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& f = kFaces[i];
      const Vec3d& a = points_[f[0]].w;
      const Vec3d n = cross(points_[f[1]].w - a, points_[f[2]].w - a);
      const double origin = -dot(n, a), other = dot(n, points_[f[3]].w - a);
      beyond[i] = !(origin * other > 0);
      within = within && !beyond[i];
      weights[f[3]] = beyond[i] ? 0 : origin / other;
      sum += weights[f[3]];
    }
    double nearest = std::numeric_limits<double>::infinity();
    Choice best;
    if (within) {
      best.count = 4;
      best.index = {0, 1, 2, 3};
      for (std::size_t i = 0; i < 4; ++i) best.weight[i] = weights[i] / sum;
      choice_ = best;
      nearest = squared();
    }
    for (std::size_t i = 0; i < 4; ++i) {
      if (!within && !beyond[i]) continue;
      if (within && nearest <= kGjkTouch * kGjkTouch) break;
      triangle(kFaces[i][0], kFaces[i][1], kFaces[i][2]);
      const double square = squared();
      if (square < nearest) {
        nearest = square;
        best = choice_;
      }
    }
    choice_ = best;
  }

  void compact() {
    const std::array<MinkowskiDifference, 4> all = points_;
    size_ = choice_.count;
    for (std::size_t i = 0; i < size_; ++i) {
      points_[i] = all[choice_.index[i]];
      weights_[i] = choice_.weight[i];
    }
  }

  std::array<MinkowskiDifference, 4> points_{};
  std::array<double, 4> weights_{};
  std::size_t size_ = 0;
  Choice choice_;
};

Vec3d first_direction(const ConvexBody& a, const ConvexBody& b) {
  const Vec3d way = a.middle - b.middle;
  return dot(way, way) > 0 ? way : Vec3d{1, 0, 0};
}

}  // namespace

GjkResult gjk_distance(const ConvexBody& a, const ConvexBody& b, double cutoff) {
  GjkResult gap;
  const double error = a.error + b.error;
  GjkSimplex simplex;
  Vec3d way = first_direction(a, b);
  for (; gap.steps < kMaxIterations; ++gap.steps) {
    const double length = norm(way);
    if (!(length > 0)) break;
    const Vec3d on_a = support(a.shape, -way), on_b = support(b.shape, way);
    const Vec3d w = on_a - on_b;
    const double slab = dot(way, w) / length - error;
    if (slab > gap.lower) {
      gap.lower = slab;
      gap.normal = way * (1 / length);
    }
    if (gap.lower >= cutoff || gap.upper - gap.lower <= kGapTolerance || simplex.holds(w)) break;
    simplex.add({w, on_a});
    way = simplex.reduce();
    const double apart = norm(way);
    if (!(apart + error < gap.upper)) break;
    gap.upper = apart + error;
    gap.on_a = simplex.mixture(&MinkowskiDifference::on_a);
    gap.on_b = gap.on_a - way;
    if (simplex.size() == 4) break;
  }
  return gap;
}

}  // namespace strake::geometry::primitive_pairs
