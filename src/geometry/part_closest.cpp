// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/corners.hpp"
#include "geometry/near_walk.hpp"
#include "geometry/pair_view.hpp"
#include "geometry/tree_walk.hpp"
#include "geometry/triangle_distance.hpp"
#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {
namespace {

/// Factor by which a double squared distance is enlarged before it may cut anything off: far above
/// the roundings of a box distance.
constexpr double kOutward = 1 + 0x1p-48;

class ClosestSearch {
 public:
  ClosestSearch(const TreedPart& a, const TreedPart& b, double limit, PairWork& work)
      : a_(a, {}),
        b_(b, b.placed.origin - a.placed.origin),
        limit_(limit),
        reach_(limit * limit * kOutward),
        work_(work) {}

  std::optional<Closest> run();
  /// Ends at the first pair of triangles that is certainly not farther apart than the limit.
  std::optional<Closest> run_until_near();

 private:
  void walk();
  std::optional<Closest> decide();

  PartView a_, b_;
  double limit_;
  double reach_;        ///< squared distances strictly above this are of no interest
  double enough_ = -1;  ///< a squared distance that is near enough to look no further
  bool near_ = false;   ///< one was found
  PairWork& work_;
  std::vector<NearTriangles> candidates_;  ///< that may be the nearest
};

void ClosestSearch::walk() {
  NearWalk(a_, b_, work_).run(reach_, [this](const NearTriangles& t) {
    if (t.squared.upper <= enough_) {
      candidates_.assign(1, t);
      near_ = true;
      return false;
    }
    candidates_.push_back(t);
    reach_ = std::min(reach_, t.squared.upper * kOutward);
    return true;
  });
}

/// The exact least among the candidates whose certified bounds overlap.
std::optional<Closest> ClosestSearch::decide() {
  std::erase_if(candidates_, [this](const NearTriangles& c) { return c.squared.lower > reach_; });
  std::ranges::sort(candidates_, [](const NearTriangles& x, const NearTriangles& y) {
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  std::optional<Closest> best;
  NearestPoints nearest;
  for (const NearTriangles& c : candidates_) {
    if (best && c.squared.lower > best->squared * kOutward) continue;
    const TriangleCorners a = a_.corners(c.a), b = b_.corners(c.b);
    if (best && not_nearer(a, b, nearest)) continue;
    ++work_.exact_fallbacks;
    const NearestPoints p = exact_distance(a, b, c.squared.upper);
    if (best && p.squared >= nearest.squared) continue;
    nearest = p;
    best.emplace();
    best->squared = ratio_to_double(p.squared.numerator, p.squared.denominator);
    best->triangle_a = c.a;
    best->triangle_b = c.b;
    if (best->squared == 0) break;
  }
  if (!best) return std::nullopt;
  best->distance = sqrt_ratio_to_double(nearest.squared.numerator, nearest.squared.denominator);
  best->on_a = nearest.on_a;
  best->on_b = nearest.on_b;
  if (!(best->distance < limit_)) return std::nullopt;
  return best;
}

std::optional<Closest> ClosestSearch::run() {
  walk();
  return decide();
}

std::optional<Closest> ClosestSearch::run_until_near() {
  enough_ = limit_ * limit_;
  walk();
  return near_ ? decide() : std::nullopt;
}

/// Squared distance of a point to a triangle, in doubles.
double squared_distance(const Vec3d& p, const Corners& t) {
  const Vec3d u = t[1] - t[0], v = t[2] - t[0], n = cross(u, v);
  double least = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d &from = t[i], e = t[(i + 1) % 3] - from, d = p - from;
    inside = inside && dot(cross(e, d), n) >= 0;
    const double along = std::clamp(dot(e, d) / dot(e, e), 0.0, 1.0);
    const Vec3d off = d - e * along;
    least = std::min(least, dot(off, off));
  }
  if (!inside) return least;
  const double height = dot(n, p - t[0]);
  return std::min(least, height * height / dot(n, n));
}

}  // namespace

std::optional<Closest> closest(const TreedPart& a, const TreedPart& b, double limit,
                               PairWork& work) {
  return ClosestSearch(a, b, limit, work).run();
}

std::optional<Closest> any_within(const TreedPart& a, const TreedPart& b, double distance,
                                  PairWork& work) {
  return ClosestSearch(a, b, distance, work).run_until_near();
}

double distance_to_surface(const TreedPart& part, const Vec3d& point, double limit) {
  const auto& nodes = part.tree->nodes();
  double best = limit * limit;
  walk_nearer_first(
      *part.tree, [&](std::uint32_t i) { return squared_gap(point, nodes[i].box.as<double>()); },
      [&](double gap) { return gap > best; },
      [&](std::uint32_t t) {
        best = std::min(best, squared_distance(point, corners_of(*part.placed.part, t)));
      });
  return std::sqrt(best);
}

}  // namespace strake::geometry
