// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/corners.hpp"
#include "geometry/heavy_walk.hpp"
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
        work_(work),
        found_{.reach = limit * limit * kOutward} {}

  std::optional<Closest> run();
  /// Ends at the first pair of triangles that is certainly not farther apart than the limit.
  std::optional<Closest> run_until_near();

 private:
  void walk();
  std::optional<Closest> decide();

  /// What a walk, or a piece of one, has found.
  struct Found {
    double reach = 0;    ///< squared distances strictly above this are of no interest
    double enough = -1;  ///< a squared distance that is near enough to look no further
    bool near = false;   ///< one was found, and is the only candidate
    PairWork work = {};
    std::vector<NearTriangles> candidates = {};  ///< that may be the nearest

    bool operator()(const NearTriangles& t) {
      near = t.squared.upper <= enough;
      if (near) candidates.clear();
      candidates.push_back(t);
      reach = std::min(reach, t.squared.upper * kOutward);
      return !near;
    }
  };

  PartView a_, b_;
  double limit_;
  PairWork& work_;
  Found found_;
};

void ClosestSearch::walk() {
  heavy_near_walk(
      a_, b_, -1, work_, [this] { return Found{.reach = found_.reach, .enough = found_.enough}; },
      [this](Found& piece) {
        found_.near = piece.near;
        found_.reach = std::min(found_.reach, piece.reach);
        auto& all = found_.candidates;
        if (piece.near || all.empty())
          all = std::move(piece.candidates);
        else
          all.insert(all.end(), piece.candidates.begin(), piece.candidates.end());
        return !piece.near;
      });
}

/// The exact least among the candidates whose certified bounds overlap.
std::optional<Closest> ClosestSearch::decide() {
  auto& candidates = found_.candidates;
  std::erase_if(candidates,
                [this](const NearTriangles& c) { return c.squared.lower > found_.reach; });
  std::ranges::sort(candidates, [](const NearTriangles& x, const NearTriangles& y) {
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  std::optional<Closest> best;
  NearestPoints nearest;
  for (const NearTriangles& c : candidates) {
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
  found_.enough = limit_ * limit_;
  walk();
  return found_.near ? decide() : std::nullopt;
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
