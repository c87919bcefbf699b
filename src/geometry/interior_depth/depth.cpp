// SPDX-License-Identifier: Apache-2.0
// Decision 0001 says why certificates come before a search.
#include "strake/geometry/depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/interior_depth/bounds/half_space_program.hpp"
#include "geometry/interior_depth/bounds/inscribed_ball.hpp"
#include "geometry/interior_depth/bounds/separating_displacement.hpp"
#include "geometry/interior_depth/solid_depth_search.hpp"
#include "geometry/interior_depth/surface_distance/distance_field.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

constexpr std::size_t kMaxVerticesTried = 128;
/// Greatest width of a bracket relative to the depth: no more than a rotation may change it.
constexpr double kFinely = 1e-3;
/// The edges of a body with more of them are not tried.
constexpr std::size_t kMaxEdgesTried = 2048;
/// Maximum number of points from which a search climbs.
constexpr std::size_t kMaxDeepest = 16;
/// Grid units: a step off a surface that the exact point location can resolve.
constexpr double kMinMove = 1.0 / 64;
/// Vertex displacements no longer than this separate bodies that the snap pushed into each other:
/// it moves either face by less than one unit, and the corner of three perpendicular faces moves
/// off each by about half of its displacement. Narrow enough for a bracket.
constexpr double kSnapApart = 5;

/// Points tried for the lower bound, each located exactly.
class Candidates {
 public:
  Candidates(const DistanceField& a, const DistanceField& b, double extent,
             const DepthOptions& goal, QueryContext& work)
      : a_(a), b_(b), margin_(kFieldError * extent), goal_(goal), work_(work) {}

  /// The depth at a point, or nothing when it is not in both.
  std::optional<double> depth_at(const Vec3d& p) { return depth_at(p, a_, b_); }
  /// Returns the depth at a point; of the two, the point is likely in the first.
  std::optional<double> depth_at(const Vec3d& p, const DistanceField& of, const DistanceField& in) {
    const Vec3d q = on_field_grid(p);
    if (goal_.within && !goal_.within->contains({q, q})) return std::nullopt;
    if (!in.contains(q, work_) || !of.contains(q, work_)) return std::nullopt;
    if (!goal_.counts(q)) return std::nullopt;
    const double depth = greater_distance(a_, b_, q);
    if (depth > best_) {
      best_ = depth;
      point_ = q;
    }
    found_.push_back({depth, q});
    return depth;
  }

  /// The deepest of the points that were tried, but for those that have a deeper one beside them.
  [[nodiscard]] std::vector<Vec3d> deepest() const {
    std::vector<TestedPoint> all = found_;
    std::ranges::sort(all, [](const TestedPoint& x, const TestedPoint& y) {
      return std::tuple(y.depth, x.at.x, x.at.y, x.at.z) <
             std::tuple(x.depth, y.at.x, y.at.y, y.at.z);
    });
    std::vector<Vec3d> deepest;
    for (const TestedPoint& f : all) {
      if (deepest.size() == kMaxDeepest) break;
      const bool beside = std::ranges::any_of(
          deepest, [&](const Vec3d& p) { return length(p - f.at) < 2 * f.depth; });
      if (!beside) deepest.push_back(f.at);
    }
    return deepest;
  }

  /// Prefers a point almost as deep as the best, at a better position, with the depth that
  /// depth_at() found.
  void prefer(const Vec3d& p, double depth) {
    if (depth >= best_ * (1 - 1e-6) - 4 * kMinMove) point_ = on_field_grid(p);
  }

  void store(Depth& depth) const {
    if (best_ <= depth.value) return;
    depth.value = best_;
    depth.lower = std::max(0.0, best_ - margin_);
    depth.point = point_;
  }

 private:
  struct TestedPoint {
    double depth = 0;
    Vec3d at;
  };

  const DistanceField &a_, &b_;
  double margin_;
  const DepthOptions& goal_;
  QueryContext& work_;
  double best_ = 0;
  Vec3d point_;
  std::vector<TestedPoint> found_;
};

/// Deepest points by the linear programs, then moved towards the middle of the common part as far
/// as the snap makes necessary.
void bracket_by_programs(const HalfSpaceProgram& spaces, Candidates& candidates, Depth& depth) {
  const InscribedBall in_a = spaces.largest_ball(true), in_b = spaces.largest_ball(false);
  depth.upper = std::max({0.0, in_a.upper, in_b.upper});
  const bool a_deeper = in_a.r >= in_b.r;
  const double deepest = std::max(in_a.r, in_b.r) * (1 - 1e-7) - 1e-3;
  InscribedBall middle = spaces.centre_of_deepest_ball(a_deeper, deepest);
  const auto at_middle = candidates.depth_at(middle.x);
  const auto at_corner = candidates.depth_at((a_deeper ? in_a : in_b).x);
  if (at_middle) candidates.prefer(middle.x, *at_middle);
  if (at_corner && at_middle && middle.r > kMinMove) return;
  // Where the deepest points lie on the surface of the other body, as on the flat of a pipe that
  // stands into a box, their middle does too: then aim for the middle of the whole common part.
  constexpr std::array<double, 5> kMoves{kMinMove, 1, 4, 16, 64};
  const InscribedBall aim =
      middle.r > kMoves.back() ? middle : spaces.centre_of_deepest_ball(a_deeper, 0);
  if (!(middle.r > kMinMove)) middle = spaces.centre_on_surface(a_deeper, deepest);
  for (const InscribedBall* s : {&in_a, &in_b, &std::as_const(middle)})
    for (const double move : kMoves) {
      if (!(aim.r > move)) break;
      const Vec3d p = s->x + (aim.x - s->x) * (move / aim.r);
      const auto depth_there = candidates.depth_at(p);
      if (!depth_there) continue;
      if (s == &middle) candidates.prefer(p, *depth_there);
      break;
    }
}

/// The corners of one body in the other: where shallow and broken overlaps are deepest.
void try_vertices(const DistanceField& of, const DistanceField& in, Candidates& candidates) {
  const Box3d room = in.box();
  if (of.has_many_vertices()) {
    const Box3d own{of.local(room.lo), of.local(room.hi)};
    for (const Vec3i& v : of.vertices().points_within(own, kMaxVerticesTried))
      candidates.depth_at(of.common(v.as<double>()), of, in);
    return;
  }
  std::size_t tried = 0;
  for (const Vec3i& v : of.part().vertices) {
    const Vec3d p = of.common(v.as<double>());
    if (!Box3d{p, p}.meets(room)) continue;
    candidates.depth_at(p, of, in);
    if (++tried == kMaxVerticesTried) return;
  }
}

/// Returns the depth that counts as a tie: it is within what the snap makes of a touch.
double tie_depth(const DepthOptions& goal) {
  return std::min(std::max(kTieDepth, std::min(goal.apart_within, goal.tolerance)), goal.threshold);
}

std::optional<Vec3d> outward(const Part& part, std::uint32_t triangle) {
  if (triangle >= part.triangles.size()) return std::nullopt;
  const Corners c = corners_of(part, triangle);
  const Vec3d n = normal_of(c);
  const double size = length(n);
  if (!(size > 0)) return std::nullopt;
  return n * (1 / size);
}

/// Tries the middles of the edges of one body clipped to the box of the other: a body that passes
/// through the other may have no vertex there.
void try_edges(const DistanceField& of, const DistanceField& in, Candidates& candidates) {
  const auto& edges = of.part().edges;
  if (edges.size() > kMaxEdgesTried) return;
  const Box3d room = in.box();
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    const Vec3d p = of.common(of.part().vertices[edges[e].v0].as<double>());
    const Vec3d way = of.common(of.part().vertices[edges[e].v1].as<double>()) - p;
    double from = 0, to = 1;
    for (int k = 0; k < 3; ++k) {
      const double lo = (room.lo[k] - p[k]) / way[k], hi = (room.hi[k] - p[k]) / way[k];
      if (way[k] != 0) {
        from = std::max(from, std::min(lo, hi));
        to = std::min(to, std::max(lo, hi));
      } else if (p[k] < room.lo[k] || p[k] > room.hi[k]) {
        to = -1;
      }
    }
    if (!(from < to)) continue;
    const Vec3d middle = p + way * ((from + to) / 2);
    // A little way in, out of the rounding.
    Vec3d inward;
    for (std::uint32_t i = edges[e].first_triangle; i < edges[e + 1].first_triangle; ++i)
      if (const auto n = outward(of.part(), of.part().edge_triangles[i])) inward = inward - *n;
    candidates.depth_at(middle + inward * kMinMove, of, in);
  }
}

/// Tries points from a point of both surfaces into both bodies, farther and farther.
void try_points_inwards(const DepthOperand& a, const DepthOperand& b, const DepthOptions& goal,
                        Candidates& candidates) {
  const auto na = outward(*a.treed.placed.part, goal.triangle_a);
  const auto nb = outward(*b.treed.placed.part, goal.triangle_b);
  if (!na || !nb) return;
  for (const Vec3d& way : {*na + *nb, *na, *nb})
    for (double step = 1; step < 1e6; step *= 3)
      candidates.depth_at(goal.meeting_point - way * step);
}

/// Ties end here, with the corners that are in the other. Bodies that are not convex may touch at
/// faces that none of their half-spaces belong to: those that moves of corners part are no deeper
/// than a tie, or than a bracket may be wide.
bool settle_tie(const DepthOperand& a, const DistanceField& fa, const DepthOperand& b,
                const DistanceField& fb, const DepthOptions& goal, Candidates& candidates,
                Depth& depth, QueryContext& work) {
  const double tie = tie_depth(goal);
  depth.upper = goal.known_upper;
  if (goal.known_upper <= tie) {
    try_vertices(fa, fb, candidates);
    try_vertices(fb, fa, candidates);
  } else {
    // Where the half-spaces give what the goal needs, they do so faster.
    if (goal.known_upper <= goal.tolerance) return false;
    if (a.planes->nearly_convex && b.planes->nearly_convex) return false;
    if (tie < 1 || goal.triangle_a == kNoIndex || goal.triangle_b == kNoIndex) return false;
    const auto shrunk = find_separating_displacement(a.treed, b.treed, tie,
                                                     std::min(kSnapApart, goal.threshold), work);
    if (!shrunk) return false;
    depth.upper = std::min(shrunk->depth, goal.known_upper);
    for (const std::uint32_t v : shrunk->corners_a)
      candidates.depth_at(fa.common(a.treed.placed.part->vertices[v].as<double>()));
    for (const std::uint32_t v : shrunk->corners_b)
      candidates.depth_at(fb.common(b.treed.placed.part->vertices[v].as<double>()));
  }
  candidates.store(depth);
  if (!(depth.value > 0)) {
    try_points_inwards(a, b, goal, candidates);
    candidates.store(depth);
  }
  depth.upper = std::max(depth.upper, depth.value);
  return true;
}

/// Translations that take b out of a: once no interior point is shared, the depth was at most their
/// length.
class SeparatingMoves {
 public:
  SeparatingMoves(const DepthOperand& a, const DepthOperand& b, const DepthOptions& goal,
                  QueryContext& work)
      : a_(a), b_(b), goal_(goal), work_(work) {
    add(outward(*a.treed.placed.part, goal.triangle_a), 1);
    add(outward(*b.treed.placed.part, goal.triangle_b), -1);
  }

  /// Bounds a tie by short translations along the normals where they meet. Ties of a rotated model
  /// end here.
  void bound_tie(Depth& depth) {
    for (const double distance : {4.0, 32.0, 256.0, goal_.threshold}) {
      if (distance > goal_.threshold || distance >= depth.upper || distance < depth.lower) continue;
      if (try_all(distance, depth)) return;
    }
  }

  /// Bounds the depth by translations as long as the known depth, out of the surfaces nearest to
  /// its point and along the normals: a body slightly inside a cavity's wall leaves it so, where
  /// hulls are no bound.
  void bound_hit(Depth& depth) {
    // Where the two bounds are near each other, they are so for a cause: a search ends soon.
    if (!(depth.value > 0 && depth.upper > kApart * depth.value)) return;
    const Vec3d& p = depth.point;
    const Vec3d shift = (b_.treed.placed.origin - a_.treed.placed.origin).as<double>();
    for (const double sign : {1.0, -1.0}) {
      const Vec3d way = sign > 0 ? nearest_on_surface(a_.treed, p).point - p
                                 : nearest_on_surface(b_.treed, p - shift).point - (p - shift);
      if (const double size = length(way); size > 0) add(way * (1 / size), sign);
    }
    (void)try_all(depth.value + kRoom, depth);
  }

 private:
  /// What the snap of a move adds to it, on either side.
  static constexpr double kRoom = 2;
  static constexpr double kSameWay = 1 - 1e-6;
  static constexpr double kApart = 1.5;

  void add(const std::optional<Vec3d>& way, double sign) {
    if (!way) return;
    const Vec3d out = *way * sign;
    if (std::ranges::none_of(ways_, [&](const Vec3d& w) { return dot(w, out) > kSameWay; }))
      ways_.push_back(out);
  }

  bool try_all(double distance, Depth& depth) {
    return std::ranges::any_of(
        ways_, [&](const Vec3d& way) { return try_move(way * (distance - 1), depth); });
  }

  /// The snap adds less than one.
  bool try_move(const Vec3d& way, Depth& depth) {
    const Vec3l move{std::llround(way.x), std::llround(way.y), std::llround(way.z)};
    PartWithBvh moved = b_.treed;
    moved.placed.origin = moved.placed.origin + move;
    const double bound = length(move.as<double>()) * (1 + kFieldError);
    if (bound >= depth.upper || !fits_pair(a_.treed.placed, moved.placed)) return false;
    const Meeting meeting = meet(a_.treed, moved, work_).meeting;
    if (meeting != Meeting::apart && meeting != Meeting::touching) return false;
    depth.upper = bound;
    return true;
  }

  const DepthOperand &a_, &b_;
  const DepthOptions& goal_;
  QueryContext& work_;
  std::vector<Vec3d> ways_;
};

/// Points about as deep as the deepest one that are more in the middle of what the two have in
/// common: of all points of a face, say, the deepest point that was found is often a corner.
class Centring {
 public:
  Centring(const DistanceField& a, const DistanceField& b, const HalfSpaceProgram& spaces,
           const DepthOptions& goal, QueryContext& work)
      : a_(a), b_(b), spaces_(spaces), goal_(goal), work_(work) {}

  void move(Depth& depth) const {
    if (!(depth.value > 2 * kSlack)) return;
    const bool deep_in_a = a_.nearest(depth.point).distance >= b_.nearest(depth.point).distance;
    const Vec3d middle =
        spaces_.centre_of_deep_points(depth.point, deep_in_a, depth.value - kSlack);
    if (length(middle - depth.point) > kShort && !move_deep(middle, deep_in_a ? a_ : b_, depth))
      move_along_axes(depth);
  }

 private:
  /// Grid units that a point may be less deep: what the snap makes of rotated faces.
  static constexpr double kAsDeep = 4;
  /// The centre is taken of the points up to this much less deep: of all of a face, although it may
  /// be slightly rotated.
  static constexpr double kSlack = 16;
  /// Grid units: a way not worth going.
  static constexpr double kShort = 16;

  /// To a place or, from there, into the body as deep as the deepest, where that is in the other.
  bool move_deep(const Vec3d& to, const DistanceField& body, Depth& depth) const {
    const NearestTriangle closest = body.nearest(to);
    const Vec3d out =
        nearest_on_triangle(body.local(to), body.corners(closest.triangle)) - body.local(to);
    const double missing = depth.value - closest.distance;
    if (!(closest.distance > 0 && missing > 0 && missing < 2 * kSlack)) return move_to(to, depth);
    for (const double less : {0.0, 1.0 / 64, 1.0, 2.0, 3.0})
      if (move_to(to - out * (std::max(missing - less, 0.0) / closest.distance), depth))
        return true;
    return move_to(to, depth);
  }

  bool move_to(const Vec3d& to, Depth& depth) const {
    const Vec3d q = on_field_grid(to);
    if (goal_.within && !goal_.within->contains({q, q})) return false;
    if (!(greater_distance(a_, b_, q) >= depth.value - kAsDeep)) return false;
    if (!a_.contains(q, work_) || !b_.contains(q, work_) || !goal_.counts(q)) return false;
    depth.point = q;
    return true;
  }

  /// Where half-spaces do not decide, as in a profile: to the middle of the common box, or of the
  /// box that counts, along each axis along which that is as deep.
  void move_along_axes(Depth& depth) const {
    for (const Vec3d& axis : a_.planes()->axes) {
      const double way = middle_along(axis) - dot(axis, depth.point);
      if (std::fabs(way) > kShort) (void)move_to(depth.point + axis * way, depth);
    }
  }

  [[nodiscard]] double middle_along(const Vec3d& axis) const {
    if (goal_.within) return dot(axis, goal_.within->lo + goal_.within->hi) / 2;
    const ProjectionInterval p = a_.range_along(axis), q = b_.range_along(axis);
    return (std::max(p.lo, q.lo) + std::min(p.hi, q.hi)) / 2;
  }

  const DistanceField &a_, &b_;
  const HalfSpaceProgram& spaces_;
  const DepthOptions& goal_;
  QueryContext& work_;
};

}  // namespace

Depth solid_depth(const DepthOperand& a, const DepthOperand& b, const DepthOptions& options,
                  QueryContext& work) {
  DepthOptions goal = options;
  goal.relative = std::min(options.relative, kFinely);
  // Coplanar faces of a rotated model: what the snap made of a touch.
  if (goal.known_upper <= std::min(kTieDepth, goal.threshold))
    return {.upper = goal.known_upper, .value = goal.known_upper, .point = goal.meeting_point};
  DistanceField fa(a.treed, {}, a.planes);
  DistanceField fb(b.treed, a.treed.placed.origin - b.treed.placed.origin, b.planes);
  const HalfSpaceProgram spaces(a, fa, b, fb, goal.within);
  Candidates candidates(fa, fb, spaces.extent(), goal, work);
  Depth depth;
  if (settle_tie(a, fa, b, fb, goal, candidates, depth, work)) return depth;
  bracket_by_programs(spaces, candidates, depth);
  depth.upper = std::min(depth.upper, goal.known_upper);
  candidates.store(depth);
  if (!bracket_suffices(depth, goal)) {
    try_vertices(fa, fb, candidates);
    try_vertices(fb, fa, candidates);
    try_points_inwards(a, b, goal, candidates);
    candidates.store(depth);
  }
  SeparatingMoves parting(a, b, goal, work);
  if (depth.lower <= goal.threshold && depth.upper > goal.threshold) parting.bound_tie(depth);
  // A translation that leaves the whole is known for the whole only, not for a part of the
  // intersection.
  if (!bracket_suffices(depth, goal) && !goal.within) parting.bound_hit(depth);
  if (!bracket_suffices(depth, goal)) {
    fa.prepare();
    fb.prepare();
    try_edges(fa, fb, candidates);
    try_edges(fb, fa, candidates);
    candidates.store(depth);
    search_solid_depth(fa, fb, goal, candidates.deepest(), depth, work);
  }
  Centring(fa, fb, spaces, goal, work).move(depth);
  depth.upper = std::max(depth.upper, depth.value);
  return depth;
}

}  // namespace strake::geometry
