// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/corners.hpp"
#include "geometry/flat_pieces.hpp"
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
  ClosestSearch(const TreedPart& a, const TreedPart& b, double limit, double slack, PairWork& work)
      : a_(a, {}),
        b_(b, b.placed.origin - a.placed.origin),
        limit_(limit),
        slack_(slack),
        work_(work),
        found_{.reach = limit * limit * kOutward} {}

  std::optional<Closest> run();
  /// Ends at the first pair of triangles that is certainly not farther apart than the limit.
  std::optional<Closest> run_until_near();

 private:
  struct Found;

  void walk();
  void take(std::vector<NearTriangles>&& candidates, double reach);
  bool settle(Found& found);
  double distance_so_far(Found& found, std::optional<Vec3d>& across);
  /// Triangles that are certainly so far apart or farther may be left out.
  [[nodiscard]] double least_of_interest(double distance) const {
    return distance < limit_ ? distance - slack_ : limit_;
  }
  void leave_out(double gap, Found& found);
  void walk_pair(const FlatPieces::Pair& pair);
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
  double slack_;
  PairWork& work_;
  Found found_;
  /// Nothing that was left out is nearer than this.
  double left_out_ = std::numeric_limits<double>::infinity();
};

void ClosestSearch::take(std::vector<NearTriangles>&& candidates, double reach) {
  found_.reach = std::min(found_.reach, reach);
  auto& all = found_.candidates;
  if (all.empty())
    all = std::move(candidates);
  else
    all.insert(all.end(), candidates.begin(), candidates.end());
}

void ClosestSearch::walk() {
  heavy_near_walk(
      a_, b_, -1, work_, [this] { return Found{.reach = found_.reach, .enough = found_.enough}; },
      [this](Found& piece) {
        found_.near = piece.near;
        if (piece.near) found_.candidates.clear();
        take(std::move(piece.candidates), piece.reach);
        return !piece.near;
      },
      [this](Found& found) { return settle(found); });
}

/// The distance of the nearest triangles of a walk so far; the limit where they are not nearer.
/// `across` is set from one to the other.
double ClosestSearch::distance_so_far(Found& found, std::optional<Vec3d>& across) {
  auto& candidates = found.candidates;
  if (candidates.empty()) return limit_;
  // One stands for all that are as near.
  const auto least = std::ranges::min_element(
      candidates, [](const auto& x, const auto& y) { return x.squared.upper < y.squared.upper; });
  std::iter_swap(candidates.begin(), least);
  const NearTriangles& best = candidates.front();
  ++found.work.exact_fallbacks;
  const NearestPoints p =
      exact_distance(a_.corners(best.a), b_.corners(best.b), best.squared.upper);
  across = p.on_b - p.on_a;
  return std::min(limit_, sqrt_ratio_to_double(p.squared.numerator, p.squared.denominator));
}

/// Of a walk that has turned out heavy, whether nothing is left that could be nearer than what it
/// has found by more than the slack: so it is for faces of many needles that lie a constant
/// distance apart. What the heights of the faces leave open is walked.
bool ClosestSearch::settle(Found& found) {
  if (found.enough >= 0) return false;
  std::optional<Vec3d> across;
  const double distance = distance_so_far(found, across);
  const auto pieces = parted_by_heights(a_, b_, least_of_interest(distance), across);
  if (!pieces) return false;
  leave_out(pieces->gap, found);
  found_.reach = found.reach;
  if (!found.candidates.empty()) found_.candidates.assign(1, found.candidates.front());
  for (const FlatPieces::Pair& pair : pieces->open) {
    (void)distance_so_far(found_, across);  // what a piece starts from stands first
    walk_pair(pair);
  }
  return true;
}

void ClosestSearch::walk_pair(const FlatPieces::Pair& pair) {
  const auto parted = [&](Found& found) {
    std::optional<Vec3d> across;
    if (!(pair.gap >= least_of_interest(distance_so_far(found, across)))) return false;
    leave_out(pair.gap, found);
    return true;
  };
  heavy_near_walk(
      pair.a->view(a_.shift()), pair.b->view(b_.shift()), -1, work_,
      [this] {
        Found piece{.reach = found_.reach};
        if (!found_.candidates.empty()) piece.candidates.push_back(found_.candidates.front());
        return piece;
      },
      [this](Found& piece) {
        take(std::move(piece.candidates), piece.reach);
        return true;
      },
      parted);
}

/// Nothing that is left out is nearer than the gap, so that the nearest found stands for all.
void ClosestSearch::leave_out(double gap, Found& found) {
  left_out_ = std::min(left_out_, gap);
  if (!found.candidates.empty()) found.candidates.resize(1);
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
  best->lower = std::min(best->distance, std::max(0.0, left_out_));
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

std::optional<Closest> closest(const TreedPart& a, const TreedPart& b, double limit, PairWork& work,
                               double slack) {
  return ClosestSearch(a, b, limit, slack, work).run();
}

std::optional<Closest> any_within(const TreedPart& a, const TreedPart& b, double distance,
                                  PairWork& work) {
  return ClosestSearch(a, b, distance, 0, work).run_until_near();
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
