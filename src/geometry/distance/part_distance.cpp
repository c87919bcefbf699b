// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/bvh/traversal.hpp"
#include "geometry/distance/distance_traversal.hpp"
#include "geometry/distance/elementary_distance.hpp"
#include "geometry/distance/slab_partition.hpp"
#include "geometry/distance/slab_proximity.hpp"
#include "geometry/distance/triangle_distance.hpp"
#include "geometry/numeric/morton_order.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/part_pair.hpp"

namespace strake::geometry {
namespace {

/// Factor by which a squared distance in doubles is enlarged before it may prune: far above the
/// roundings of a box distance.
constexpr double kOutward = 1 + 0x1p-48;

/// Number of triangles of either of two flat pieces that are probed for whether the pieces lie over
/// each other, and how much farther apart than their heights they may then be, grid units.
/// Together with samples of near triangles the probes bring fans of 200,000 triangles aside of each
/// other's hubs from up to 320 µs a triangle to 1.4 at most (bench clash_pairs).
constexpr std::size_t kProbes = 64;
constexpr double kProbeSlack = 4;

/// Maximum number of triangles at an end of a slab between two parts for which all pairs are tried.
/// The slab of the hulls brings the distances of a turned plant of 100,000 objects from 1.2 to 0.06
/// CPU s (decision 0022).
constexpr std::size_t kSlabFaces = 32;

class ClosestSearch {
 public:
  ClosestSearch(const PartWithBvh& a, const PartWithBvh& b, double limit, double slack,
                QueryContext& work)
      : a_(a, {}),
        b_(b, b.placed.origin - a.placed.origin),
        limit_(limit),
        slack_(slack),
        work_(work),
        found_{.reach = limit * limit * kOutward} {}

  /// `separating_direction`: see find_closest_pair().
  std::optional<ClosestPair> run(const std::optional<Vec3d>& separating_direction);
  /// Ends at the first pair of triangles that is certainly not farther apart than the limit.
  std::optional<ClosestPair> run_until_near();

 private:
  struct Found;
  /// A triangle of one of the two.
  struct Probe {
    const PairLocalPart& view;
    std::uint32_t triangle = 0;
    bool of_a = true;
  };

  void walk();
  void offer(const SlabFaces& faces);
  void take(std::vector<NearTrianglePair>&& candidates, double reach);
  bool settle(Found& found);
  double distance_so_far(Found& found, std::optional<Vec3d>& across);
  /// Returns the distance from which on triangles may be left out.
  [[nodiscard]] double pruning_distance(double distance) const {
    return distance < limit_ ? distance - slack_ : limit_;
  }
  void leave_out(double gap, Found& found);
  bool settle_near(Found& found);
  void probe(const SlabPartition::Pair& pair, double limit, Found& found) const;
  static void probe(const Probe& from, const PairLocalPart& to, double limit, Found& found);
  void traverse_pair(const SlabPartition::Pair& pair);
  std::optional<ClosestPair> decide();

  /// The result of a traversal, or of a subtask of one.
  struct Found {
    double reach = 0;    ///< squared distances strictly above this are pruned
    double cutoff = -1;  ///< a squared distance that ends the search
    bool near = false;   ///< such a pair was found, and is the only candidate
    QueryContext work = {};
    std::vector<NearTrianglePair> candidates = {};  ///< pairs that may be the nearest

    bool operator()(const NearTrianglePair& t) {
      near = t.squared.upper <= cutoff;
      if (near) candidates.clear();
      candidates.push_back(t);
      reach = std::min(reach, t.squared.upper * kOutward);
      return !near;
    }
  };

  PairLocalPart a_, b_;
  double limit_;
  double slack_;
  QueryContext& work_;
  Found found_;
  /// Nothing that was left out is nearer than this.
  double left_out_ = std::numeric_limits<double>::infinity();
};

void ClosestSearch::take(std::vector<NearTrianglePair>&& candidates, double reach) {
  found_.reach = std::min(found_.reach, reach);
  auto& all = found_.candidates;
  if (all.empty())
    all = std::move(candidates);
  else
    all.insert(all.end(), candidates.begin(), candidates.end());
}

void ClosestSearch::walk() {
  adaptive_distance_traversal(
      a_, b_, -1, work_, [this] { return Found{.reach = found_.reach, .cutoff = found_.cutoff}; },
      [this](Found& piece) {
        found_.near = piece.near;
        if (piece.near) found_.candidates.clear();
        take(std::move(piece.candidates), piece.reach);
        return !piece.near;
      },
      [this](Found& found) { return settle(found); });
}

/// Returns the distance of the nearest triangles of a traversal so far; the limit where they are
/// not nearer. `across` is set from one to the other.
double ClosestSearch::distance_so_far(Found& found, std::optional<Vec3d>& across) {
  auto& candidates = found.candidates;
  if (candidates.empty()) return limit_;
  // One represents all that are as near.
  const auto least = std::ranges::min_element(
      candidates, [](const auto& x, const auto& y) { return x.squared.upper < y.squared.upper; });
  std::iter_swap(candidates.begin(), least);
  const NearTrianglePair& best = candidates.front();
  ++found.work.exact_fallbacks;
  const NearestTrianglePoints p =
      exact_triangle_distance(a_.corners(best.a), b_.corners(best.b), best.squared.upper);
  across = p.on_b - p.on_a;
  return std::min(limit_, sqrt_ratio_to_double(p.squared.numerator, p.squared.denominator));
}

/// Whether a heavy traversal has nothing left that could be nearer than what it has found by more
/// than the slack, as for faces of many slivers at a constant distance. Pairs that the heights of
/// the faces leave open are traversed.
bool ClosestSearch::settle(Found& found) {
  if (found.cutoff >= 0) return settle_near(found);
  std::optional<Vec3d> across;
  const double distance = distance_so_far(found, across);
  SlabOptions question{.apart = pruning_distance(distance), .hint = across};
  auto pieces = partition_by_height(a_, b_, question);
  if (!pieces && found.candidates.empty()) {
    // So long a traversal without a result: faces of slivers may all be within the limit.
    question.whatever_is_left = true;
    pieces = partition_by_height(a_, b_, question);
  }
  if (!pieces) return false;
  leave_out(pieces->gap, found);
  found_.reach = found.reach;
  if (!found.candidates.empty()) found_.candidates.assign(1, found.candidates.front());
  // The result of the nearest ones separates most of the others.
  for (const SlabPartition::Pair& pair : pieces->open) traverse_pair(pair);
  work_ += found_.work;
  found_.work = {};
  return true;
}

/// The same for a traversal that seeks any pair near enough: there is none, or it is found where
/// flat faces lie over each other.
bool ClosestSearch::settle_near(Found& found) {
  const auto pieces = partition_by_height(a_, b_, {.apart = limit_ * kOutward});
  if (!pieces) return false;
  for (const SlabPartition::Pair& pair : pieces->open) {
    probe(pair, limit_, found);
    if (found.near) return true;
  }
  return pieces->open.empty();
}

/// Probes whether two flat pieces come within a limit of each other at some points of either, and
/// offers what it finds. Boxes of slivers mislead a traversal there.
void ClosestSearch::probe(const SlabPartition::Pair& pair, double limit, Found& found) const {
  const PairLocalPart a = pair.a->view(a_.shift()), b = pair.b->view(b_.shift());
  for (std::size_t i = 0; i < kProbes; ++i) {
    probe({a, sample(a.tree().order(), i, kProbes), true}, b, limit, found);
    if (found.near || found.reach <= limit * limit) return;
    probe({b, sample(b.tree().order(), i, kProbes), false}, a, limit, found);
    if (found.near || found.reach <= limit * limit) return;
  }
}

/// Offers a triangle and the first of the other piece that is near one of its points.
void ClosestSearch::probe(const Probe& from, const PairLocalPart& to, double limit, Found& found) {
  const double squared = limit * limit;
  const TriangleCorners corners = from.view.corners(from.triangle);
  const Corners c = as_doubles(corners);
  const auto offer = [&](std::uint32_t t) {
    const DoubleTriangle own(corners), other(to.corners(t));
    ++found.work.triangle_pairs;
    const DistanceBounds bounds = triangle_distance_bounds(
        from.of_a ? own : other, from.of_a ? other : own, found.reach, found.cutoff);
    if (bounds.lower > found.reach) return true;
    return found({bounds, from.of_a ? from.triangle : t, from.of_a ? t : from.triangle}) &&
           found.reach > squared;
  };
  for (const Vec3d& point : {(c[0] + c[1] + c[2]) * (1.0 / 3), c[0], c[1], c[2]}) {
    const Vec3d p = point - to.shift().as<double>();
    const auto near = [&](const TriangleBvh::Node& node) {
      ++found.work.node_pairs;
      return squared_gap(p, node.box.as<double>()) <= squared;
    };
    const auto is_over = [&](std::uint32_t t) {
      return squared_distance(p, corners_of(to.part(), t)) <= squared;
    };
    if (!traverse_bvh(to.tree(), near, [&](std::uint32_t t) { return !is_over(t) || offer(t); }))
      return;
  }
}

void ClosestSearch::traverse_pair(const SlabPartition::Pair& pair) {
  const auto parted = [&](Found& found) {
    std::optional<Vec3d> across;
    if (!(pair.gap >= pruning_distance(distance_so_far(found, across)))) return false;
    leave_out(pair.gap, found);
    return true;
  };
  if (parted(found_)) return;
  const double limit = std::max(pair.gap, 0.0) + kProbeSlack;
  if (limit * limit < found_.reach) probe(pair, limit, found_);
  if (parted(found_)) return;
  adaptive_distance_traversal(
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

/// Leaves pairs out: none is nearer than the gap, so that the nearest found represents them.
void ClosestSearch::leave_out(double gap, Found& found) {
  left_out_ = std::min(left_out_, gap);
  if (!found.candidates.empty()) found.candidates.resize(1);
}

/// Returns the exact minimum among the candidates whose certified bounds overlap.
std::optional<ClosestPair> ClosestSearch::decide() {
  auto& candidates = found_.candidates;
  std::erase_if(candidates,
                [this](const NearTrianglePair& c) { return c.squared.lower > found_.reach; });
  std::ranges::sort(candidates, [](const NearTrianglePair& x, const NearTrianglePair& y) {
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  std::optional<ClosestPair> best;
  NearestTrianglePoints nearest;
  for (const NearTrianglePair& c : candidates) {
    if (best && c.squared.lower > best->squared * kOutward) continue;
    const TriangleCorners a = a_.corners(c.a), b = b_.corners(c.b);
    if (best && not_nearer(a, b, nearest)) continue;
    ++work_.exact_fallbacks;
    const NearestTrianglePoints p = exact_triangle_distance(a, b, c.squared.upper);
    if (best && p.squared >= nearest.squared) continue;
    nearest = p;
    best = as_closest_pair(p, {c.a, c.b});
    if (best->squared == 0) break;
  }
  if (!best) return std::nullopt;
  best->lower = std::min(best->distance, std::max(0.0, left_out_));
  if (!(best->distance < limit_)) return std::nullopt;
  return best;
}

void ClosestSearch::offer(const SlabFaces& faces) {
  std::vector<DoubleTriangle> all;
  all.reserve(faces.b.size());
  for (const std::uint32_t t : faces.b) all.emplace_back(b_.corners(t));
  for (const std::uint32_t s : faces.a) {
    const DoubleTriangle a(a_.corners(s));
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (squared_gap(a.box, all[j].box) > found_.reach) continue;
      ++work_.triangle_pairs;
      const DistanceBounds bounds = triangle_distance_bounds(a, all[j], found_.reach, -1);
      if (bounds.lower <= found_.reach) found_({bounds, s, faces.b[j]});
    }
  }
}

std::optional<ClosestPair> ClosestSearch::run(const std::optional<Vec3d>& separating_direction) {
  if (const auto faces = separating_direction
                             ? slab_faces(a_, b_, *separating_direction, kSlabFaces)
                             : std::nullopt) {
    offer(*faces);
    const auto near = decide();
    if ((near ? near->distance : limit_) < faces->beyond) return near;
    // The traversal will find them again.
    found_.candidates.clear();
  }
  walk();
  return decide();
}

std::optional<ClosestPair> ClosestSearch::run_until_near() {
  found_.cutoff = limit_ * limit_;
  walk();
  return found_.near ? decide() : std::nullopt;
}

}  // namespace

std::optional<ClosestPair> find_closest_pair(const PartWithBvh& a, const PartWithBvh& b,
                                             double limit, QueryContext& work, double slack,
                                             const std::optional<Vec3d>& separating_direction) {
  return ClosestSearch(a, b, limit, slack, work).run(separating_direction);
}

std::optional<ClosestPair> find_pair_within(const PartWithBvh& a, const PartWithBvh& b,
                                            double distance, QueryContext& work) {
  return ClosestSearch(a, b, distance, 0, work).run_until_near();
}

double distance_to_surface(const PartWithBvh& part, const Vec3d& point, double limit) {
  const auto& nodes = part.tree->nodes();
  double best = limit * limit;
  traverse_nearest_first(
      *part.tree, [&](std::uint32_t i) { return squared_gap(point, nodes[i].box.as<double>()); },
      [&](double gap) { return gap > best; },
      [&](std::uint32_t t) {
        best = std::min(best, squared_distance(point, corners_of(*part.placed.part, t)));
      });
  return std::sqrt(best);
}

}  // namespace strake::geometry
