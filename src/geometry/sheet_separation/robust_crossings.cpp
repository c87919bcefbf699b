// SPDX-License-Identifier: Apache-2.0
#include "geometry/sheet_separation/robust_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/distance/distance_traversal.hpp"
#include "geometry/intersect/intersection_segments.hpp"
#include "geometry/intersect/radial_sort.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/sheet_separation/vertex_displacements.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

/// Work limit: steps of the traversal per triangle. Sheets that coincide everywhere take about 20.
constexpr std::uint64_t kMinSteps = 4096, kStepsPerTriangle = 256;

/// Whether a triangle lies within a distance of another's plane.
bool lies_along(const TriangleCorners& t, const TriangleCorners& other, double distance) {
  const ExactPlane plane(other[0], other[1], other[2]);
  const Vec3d& n = plane.normal();
  const double reach = distance * std::sqrt(dot(n, n));
  return std::ranges::all_of(
      t, [&](const Vec3l& p) { return std::fabs(dot(n, (p - other[0]).as<double>())) <= reach; });
}

class Gatherer {
 public:
  Gatherer(const PairLocalPart& a, const PairLocalPart& b, bool of_b, double distance,
           QueryContext& work)
      : a_(a), b_(b), of_b_(of_b), own_(of_b ? b : a), distance_(distance), work_(work) {
    found_.number.assign(own_.part().triangles.size(), ProximityPatches::kNone);
  }

  std::optional<ProximityPatches> run() {
    if (!walk()) return std::nullopt;
    std::ranges::sort(found_.triangles, {}, &PatchTriangle::triangle);
    for (std::uint32_t i = 0; i < found_.triangles.size(); ++i)
      found_.number[found_.triangles[i].triangle] = i;
    join();
    return std::move(found_);
  }

 private:
  bool walk() {
    const double reach = distance_ * distance_;
    const std::uint64_t limit =
        kMinSteps + kStepsPerTriangle * (a_.part().triangles.size() + b_.part().triangles.size());
    DistanceTraversal walk(a_, b_, work_, reach);
    walk.start(reach);
    return walk.run(
               reach,
               [&](const NearTrianglePair& near) {
                 add(near);
                 return true;
               },
               limit) == TraversalEnd::done;
  }

  void add(const NearTrianglePair& near) {
    const std::uint32_t t = of_b_ ? near.b : near.a;
    std::uint32_t& number = found_.number[t];
    if (number == ProximityPatches::kNone) {
      number = static_cast<std::uint32_t>(found_.triangles.size());
      found_.triangles.push_back({.triangle = t});
    }
    PatchTriangle& known = found_.triangles[number];
    if (known.along) return;
    const TriangleCorners s = a_.corners(near.a), u = b_.corners(near.b);
    known.along = lies_along(s, u, distance_) || lies_along(u, s, distance_);
  }

  void join() {
    ParityUnionFind sets(found_.triangles.size());
    std::vector<bool> twisted(found_.triangles.size(), false);
    for (std::uint32_t i = 0; i < found_.triangles.size(); ++i)
      for (int edge = 0; edge < 3; ++edge) join(i, edge, sets, twisted);
    found_.two_sided.assign(found_.triangles.size(), true);
    for (std::uint32_t i = 0; i < found_.triangles.size(); ++i) {
      const ParityUnionFind::Root root = sets.find(i);
      found_.triangles[i].area = root.root;
      found_.triangles[i].swapped = root.swapped;
      if (twisted[i]) found_.two_sided[root.root] = false;
    }
  }

  void join(std::uint32_t i, int edge, ParityUnionFind& sets, std::vector<bool>& twisted) const {
    const Part& part = own_.part();
    const std::uint32_t t = found_.triangles[i].triangle;
    const Triangle& corner = part.triangles[t];
    const std::uint32_t u = corner[at(edge)], v = corner[at(next_corner(edge))];
    for (const std::uint32_t other : edge_star(part, t, edge)) {
      const std::uint32_t j = found_.number[other];
      if (other <= t || j == ProximityPatches::kNone) continue;
      // Neighbours that face the same way run along their edge in opposite directions.
      if (!sets.join(i, j, has_directed_edge(part.triangles[other], u, v))) twisted[i] = true;
    }
  }

  const PairLocalPart &a_, &b_;
  bool of_b_;
  const PairLocalPart& own_;
  double distance_;
  QueryContext& work_;
  ProximityPatches found_;
};

}  // namespace

std::optional<ProximityPatches> find_proximity_patches(const PairLocalPart& a,
                                                       const PairLocalPart& b, bool of_b,
                                                       double distance, QueryContext& work) {
  return Gatherer(a, b, of_b, distance, work).run();
}

namespace {

/// Work limits: segments that are tested, and attempts for the areas of one sheet. Each area may
/// fail on either side, at first and when its ends are held back, and where it stays may keep its
/// neighbours from moving. A heavy pair, of which not all pieces are known at first, has one
/// attempt for either side, and one more. Sheets of 100,000 and 400,000 triangles that lie on each
/// other all over take 6.0 CPU s, and 1.7 where no attempt is made (decision 0019).
constexpr std::size_t kMaxPieces = std::size_t{1} << 18U;
constexpr int kMaxAttempts = 8, kMaxAttemptsIfHeavy = 3;
/// Longest displacement, grid units: sheets that need longer ones have meaningless numbers.
constexpr double kLongestMove = 1 << 20;

/// One of two sheets: that which is moved.
struct Mover {
  bool is_b = false;

  [[nodiscard]] const PartWithBvh& of(const PartWithBvh& a, const PartWithBvh& b) const {
    return is_b ? b : a;
  }
  [[nodiscard]] const PartWithBvh& other(const PartWithBvh& a, const PartWithBvh& b) const {
    return is_b ? a : b;
  }
  [[nodiscard]] std::uint32_t triangle(const IntersectionSegment& p) const {
    return is_b ? p.b : p.a;
  }
  /// All its triangles that hold the piece.
  [[nodiscard]] std::span<const std::uint32_t> triangles(const Part& part,
                                                         const IntersectionSegment& p) const {
    const int edge = is_b ? p.edge_b : p.edge_a;
    const std::uint32_t& t = is_b ? p.b : p.a;
    return edge < 0 ? std::span(&t, 1) : edge_star(part, t, edge);
  }
};

/// Of a point in a triangle.
double distance_to_edges(const Vec3d& p, const Corners& t) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d along = t[(i + 1) % 3] - t[i];
    least = std::min(least, length(cross(along, p - t[i])) / length(along));
  }
  return least;
}

/// Whether the triangles of a segment pass through each other so far round a point of it that no
/// displacements separate them. Each holds a disc round the point; the circle of one stays linked
/// with the circle of the other as long as no point moves by half of what either reaches off the
/// other's plane.
bool certainly_lasts(const PairLocalPart& a, const PairLocalPart& b,
                     const IntersectionSegment& piece, double within) {
  if (piece.edge_a >= 0 || piece.edge_b >= 0) return false;
  const auto segment = segment_geometry(a, b, piece);
  if (!segment) return false;
  const Vec3d middle = ((*segment)[0] + (*segment)[1]) * 0.5;
  const Corners s = as_doubles(a.corners(piece.a)), t = as_doubles(b.corners(piece.b));
  const double radius = std::min(distance_to_edges(middle, s), distance_to_edges(middle, t));
  const Vec3d n = normal_of(s), m = normal_of(t);
  const double sine = length(cross(n, m)) / (length(n) * length(m));
  return radius * sine > 3 * within + 3;
}

/// A sheet with some of its vertices displaced.
struct MovedSheet {
  Part part;
  std::vector<bool> moved;  ///< by vertex
  TriangleBvh tree = {};

  MovedSheet(const Part& sheet, std::span<const VertexDisplacement> moves)
      : part(sheet), moved(sheet.vertices.size(), false) {
    for (const VertexDisplacement& move : moves) {
      part.vertices[move.vertex] = part.vertices[move.vertex] + move.by;
      moved[move.vertex] = true;
    }
    part.box = box_of(part.vertices);
  }

  /// A corner of the triangle or more.
  [[nodiscard]] bool moves(const Triangle& t) const {
    return moved[t[0]] || moved[t[1]] || moved[t[2]];
  }

  /// A triangle that has no area any more.
  [[nodiscard]] bool is_flattened(const Triangle& t) const {
    if (!moves(t)) return false;
    const auto at = [&](std::size_t i) { return part.vertices[t[i]].as<std::int64_t>(); };
    return cross_exact(at(1) - at(0), at(2) - at(0)) == Vec3<Int128>{};
  }
};

/// Displaces vertices of one of two sheets, area by area.
class Parting {
 public:
  Parting(const PartWithBvh& a, const PartWithBvh& b, Mover mover, double within,
          QueryContext& work)
      : treed_a_(a),
        treed_b_(b),
        a_(a, {}),
        b_(b, b.placed.origin - a.placed.origin),
        mover_(mover),
        placed_(mover.of(a, b).placed),
        part_(*placed_.part),
        within_(within),
        work_(work) {}

  /// Returns the displaced sheet if it crosses less, and reduces the segments to those left.
  std::optional<MovedSheet> run(IntersectionSegments& pieces) {
    if (!choose(pieces)) return std::nullopt;
    const int limit = pieces.truncated ? kMaxAttemptsIfHeavy : kMaxAttempts;
    for (int attempt = 0; attempt < limit; ++attempt) {
      MovedSheet moved = moved_sheet();
      if (!fits_pair({&moved.part, placed_.origin}, mover_.other(treed_a_, treed_b_).placed))
        return std::nullopt;
      IntersectionSegments left = robust_segments_of(moved);
      if (moving_ > 0 && left.truncated) return std::nullopt;
      if (std::ranges::none_of(plans_, [](const Plan& p) { return p.failed || p.pokes; })) {
        pieces = std::move(left);
        return moved;
      }
      if (!try_others()) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  /// What is to become of an area.
  struct Plan {
    bool moves = false;
    bool lost = false;    ///< it holds a piece that certainly lasts, or has no two sides
    bool outward = true;  ///< to the outer side of its first triangle
    bool tried = false;   ///< the other side was
    bool failed = false;
    bool pokes = false;  ///< it fails with nothing but ends that reach through by little
    bool held = false;   ///< they were held back, on this side
  };

  /// A corner that an area holds back from what it ends on.
  struct End {
    std::uint32_t area = 0;
    VertexDirection back;
  };

  /// Areas that hold pieces, but none that certainly last; where not all pieces are known, all such
  /// areas. False where there are none.
  bool choose(const IntersectionSegments& pieces) {
    std::vector<bool> lasts(part_.triangles.size(), false);
    const std::vector<std::uint32_t> doubtful = doubtful_triangles(pieces.all, lasts);
    if (doubtful.empty()) return false;
    auto near = find_proximity_patches(a_, b_, mover_.is_b, within_, work_);
    if (!near) return false;
    near_ = std::move(*near);
    plans_.assign(near_.triangles.size(), {});
    for (const std::uint32_t t : doubtful)
      if (const PatchTriangle* known = near_.find(t)) plans_[known->area].moves = true;
    for (const PatchTriangle& t : near_.triangles) {
      Plan& plan = plans_[t.area];
      if (pieces.truncated) plan.moves = true;
      if (lasts[t.triangle] || !near_.two_sided[t.area]) plan.lost = true;
    }
    for (Plan& plan : plans_) plan.moves = plan.moves && !plan.lost;
    return count_moving() > 0;
  }

  /// The triangles that hold pieces, but for those that join over edges to one that holds a piece
  /// that certainly lasts. Marks these and all they join to.
  std::vector<std::uint32_t> doubtful_triangles(const std::vector<IntersectionSegment>& pieces,
                                                std::vector<bool>& lasts) const {
    std::vector<bool> holds(part_.triangles.size(), false);
    std::vector<std::uint32_t> spread, all;
    for (const IntersectionSegment& piece : pieces) {
      const std::uint32_t t = mover_.triangle(piece);
      if (!holds[t]) all.push_back(t);
      holds[t] = true;
      if (lasts[t] || !certainly_lasts(a_, b_, piece, within_)) continue;
      lasts[t] = true;
      spread.push_back(t);
    }
    while (!spread.empty()) {
      const std::uint32_t t = spread.back();
      spread.pop_back();
      for (int edge = 0; edge < 3; ++edge)
        for (const std::uint32_t other : edge_star(part_, t, edge)) {
          if (!holds[other] || lasts[other]) continue;
          lasts[other] = true;
          spread.push_back(other);
        }
    }
    std::erase_if(all, [&](std::uint32_t t) { return lasts[t]; });
    return all;
  }

  std::size_t count_moving() {
    moving_ = static_cast<std::size_t>(std::ranges::count_if(plans_, &Plan::moves));
    return moving_;
  }

  MovedSheet moved_sheet() {
    std::vector<MovingTriangle> moving;
    owners_.clear();
    for (const PatchTriangle& t : near_.triangles) {
      const Plan& plan = plans_[t.area];
      if (!plan.moves) continue;
      moving.push_back({t.triangle, plan.outward != t.swapped, t.along});
      for (const std::uint32_t v : part_.triangles[t.triangle]) owners_.emplace_back(v, t.area);
    }
    std::ranges::sort(owners_);
    const auto twice = std::ranges::unique(owners_);
    owners_.erase(twice.begin(), twice.end());
    std::vector<VertexDirection> back;
    back.reserve(ends_.size());
    for (const End& end : ends_) back.push_back(end.back);
    return {part_, vertex_displacements(part_, moving, back, within_)};
  }

  /// The pieces that are left; the plans that fail are marked, and those with ends to hold back.
  /// Only some of them where all fail.
  IntersectionSegments robust_segments_of(MovedSheet& sheet) {
    for (std::uint32_t t = 0; t < part_.triangles.size(); ++t)
      if (sheet.is_flattened(part_.triangles[t])) fail_at(t, sheet);
    if (std::ranges::any_of(plans_, &Plan::failed)) return {};
    sheet.tree = TriangleBvh(sheet.part, work_.context());
    const PartWithBvh own{{&sheet.part, placed_.origin}, &sheet.tree};
    const PartWithBvh &a = mover_.is_b ? treed_a_ : own, &b = mover_.is_b ? own : treed_b_;
    const PairLocalPart view_a(a, a_.shift()), view_b(b, b_.shift());
    const auto note = [&](const IntersectionSegment& piece) {
      for (const std::uint32_t t : mover_.triangles(part_, piece))
        if (sheet.moves(part_.triangles[t]) &&
            !hold_back(retraction_directions(view_a, view_b, piece, mover_.is_b, t, 2 * within_),
                       sheet))
          fail_at(t, sheet);
      return moving_ == 0;
    };
    IntersectionSegments left = find_intersection_segments(a, b, kMaxPieces, work_, note);
    // Of those along areas that lie on the other sheet exactly that is decided in the end.
    for (const IntersectionSegment& piece : left.all) note(piece);
    return left;
  }

  template <class Visit>
  void for_owners(std::uint32_t vertex, Visit&& visit) const {
    const auto first = std::ranges::lower_bound(owners_, std::pair(vertex, std::uint32_t{0}));
    for (auto it = first; it != owners_.end() && it->first == vertex; ++it) visit(it->second);
  }

  /// The areas that move a corner of the triangle.
  void fail_at(std::uint32_t triangle, const MovedSheet& sheet) {
    for (const std::uint32_t v : part_.triangles[triangle]) {
      if (!sheet.moved[v]) continue;
      for_owners(v, [&](std::uint32_t area) {
        moving_ -= plans_[area].failed ? 0U : 1U;
        plans_[area].failed = true;
      });
    }
  }

  /// Has the corners held back in the next attempt. False where they were already, or do not move.
  bool hold_back(const std::vector<VertexDirection>& ways, const MovedSheet& sheet) {
    bool held = false;
    for (const VertexDirection& back : ways) {
      if (!sheet.moved[back.vertex]) continue;
      for_owners(back.vertex, [&](std::uint32_t area) {
        Plan& plan = plans_[area];
        if (plan.held) return;
        ends_.push_back({area, back});
        plan.pokes = held = true;
      });
    }
    return held;
  }

  /// On the same side, where corners that are held back may do; to the other side, where that was
  /// not tried; then not at all. False where nothing moves.
  bool try_others() {
    std::erase_if(ends_, [&](const End& end) { return plans_[end.area].failed; });
    for (Plan& plan : plans_) {
      plan.held = !plan.failed && (plan.held || plan.pokes);
      plan.pokes = false;
      if (!plan.failed) continue;
      plan.failed = false;
      plan.moves = !plan.tried;
      plan.outward = !plan.outward;
      plan.tried = true;
    }
    return count_moving() > 0;
  }

  const PartWithBvh &treed_a_, &treed_b_;
  PairLocalPart a_, b_;
  Mover mover_;
  PlacedPart placed_;
  const Part& part_;
  double within_;
  QueryContext& work_;
  ProximityPatches near_;
  std::vector<Plan> plans_;  ///< by area
  std::vector<End> ends_;    ///< of areas that move
  std::size_t moving_ = 0;   ///< plans that move and have not failed
  std::vector<std::pair<std::uint32_t, std::uint32_t>> owners_;  ///< vertices that areas move
};

}  // namespace

IntersectionSegments keep_robust_segments(const PartWithBvh& a, const PartWithBvh& b,
                                          IntersectionSegments pieces, double within,
                                          std::size_t limit, QueryContext& work) {
  if (!(within >= 1) || within > kLongestMove || pieces.all.empty()) return pieces;
  const auto moved_a = Parting(a, b, {.is_b = false}, within, work).run(pieces);
  // Of a heavy pair one view has to do.
  if (!pieces.all.empty() && !pieces.truncated) {
    const PartWithBvh other =
        moved_a ? PartWithBvh{{&moved_a->part, a.placed.origin}, &moved_a->tree} : a;
    Parting(other, b, {.is_b = true}, within, work).run(pieces);
  }
  if (pieces.all.size() > limit) {
    pieces.all.resize(limit);
    pieces.truncated = true;
  }
  return pieces;
}

SheetIntersection find_sheet_intersection(const PartWithBvh& a, const PartWithBvh& b, double within,
                                          std::size_t limit, QueryContext& work) {
  const PairLocalPart view_a(a, {}), view_b(b, b.placed.origin - a.placed.origin);
  const IntersectionSegments pieces = keep_robust_segments(
      a, b, find_intersection_segments(a, b, limit, work), within, limit, work);
  SheetIntersection curve{
      .segments = {}, .pieces = {}, .crosses = !pieces.all.empty(), .truncated = pieces.truncated};
  for (const IntersectionSegment& piece : pieces.all) {
    const auto segment = segment_geometry(view_a, view_b, piece);
    if (!segment) continue;
    curve.segments.push_back(*segment);
    curve.pieces.push_back(piece);
  }
  return curve;
}

}  // namespace strake::geometry
