// SPDX-License-Identifier: Apache-2.0
#include "geometry/interior_depth/sheets/sheet_crossing.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <optional>
#include <queue>

#include "geometry/interior_depth/sheets/sheet_boundary.hpp"
#include "geometry/interior_depth/solid_depth_search.hpp"
#include "geometry/interior_depth/surface_distance/nearest_triangle.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/sheet_separation/robust_crossings.hpp"

namespace strake::geometry {
namespace {

/// Maximum number of segments searched for: two sheets that cross all over have about one per
/// triangle (two surveys of 180,000 triangles each have 290,000, decision 0040), two of slivers
/// through each other the square of their number.
constexpr std::size_t kSegmentsPerTriangle = 2, kMinSegments = 20000;
/// Far above what double arithmetic makes of a distance within a pair, grid units.
constexpr double kSlack = 1.0 / 256;
/// Relative width of a bracket: this narrow, it costs a curve only a few halvings more than a wide
/// one. It is as cheap as 0.02 was before segments had a convex bound (decision 0040).
constexpr double kRelative = 1e-4;

double size_of(const Part& p) { return length(p.box.hi.as<double>() - p.box.lo.as<double>()); }

std::size_t max_segments(const Part& a, const Part& b) {
  return std::max(kMinSegments, kSegmentsPerTriangle * (a.triangles.size() + b.triangles.size()));
}

}  // namespace

struct SheetCrossing::Curves {
  SheetIntersection crossing;
  std::vector<CrossingSegment> crossing_segments;  ///< by segment of the crossing
  Vec3d shift;                                     ///< of b's origin off a's
  SegmentBvh boundary_a, boundary_b;  ///< the boundary curves, in the parts' own coordinates
  double ceiling = 0;                 ///< no deeper, whatever the curves

  Curves(const PartWithBvh& a, const PartWithBvh& b, double apart_within, QueryContext& work)
      : crossing(find_sheet_intersection(a, b, apart_within,
                                         max_segments(*a.placed.part, *b.placed.part), work)),
        shift((b.placed.origin - a.placed.origin).as<double>()),
        boundary_a(boundary_edges(*a.placed.part)),
        boundary_b(boundary_edges(*b.placed.part)),
        ceiling(std::min(size_of(*a.placed.part), size_of(*b.placed.part))) {
    crossing_segments.reserve(crossing.pieces.size());
    for (const IntersectionSegment& piece : crossing.pieces)
      crossing_segments.push_back({piece.a, piece.b});
  }
};

namespace {

/// A piece of the intersection curve.
struct CurvePiece {
  std::array<Vec3d, 2> end;
  double upper = 0;
  std::uint32_t id = 0;
};

struct LessPromising {
  bool operator()(const CurvePiece& x, const CurvePiece& y) const {
    return x.upper != y.upper ? x.upper < y.upper : x.id > y.id;
  }
};

/// Finds the deepest point of some pieces of the intersection curve by branch and bound with
/// bisection.
class CurveSearch {
 public:
  CurveSearch(const SegmentBvh& boundary_a, const SegmentBvh& boundary_b, const Vec3d& shift,
              double ceiling, const DepthOptions& goal)
      : boundary_a_(boundary_a),
        boundary_b_(boundary_b),
        shift_(shift),
        ceiling_(ceiling),
        goal_(goal) {
    goal_.relative = std::min(goal.relative, kRelative);
  }

  void add(const std::array<Vec3d, 2>& end) {
    ++pieces_;
    evaluate(end);
  }

  /// `complete`: whether there is nothing but what was added.
  Depth run(bool complete) {
    depth_.complete = complete;
    if (!complete) depth_.upper = ceiling_;
    while (!open_.empty()) {
      const CurvePiece piece = open_.top();
      depth_.upper = std::max(complete ? piece.upper : ceiling_, depth_.value);
      if (bracket_suffices(depth_, goal_)) return depth_;
      if (depth_.cells >= limit()) {
        depth_.complete = false;
        return depth_;
      }
      open_.pop();
      const Vec3d middle = (piece.end[0] + piece.end[1]) * 0.5;
      evaluate({piece.end[0], middle});
      evaluate({middle, piece.end[1]});
    }
    if (complete) depth_.upper = depth_.value + kSlack;
    return depth_;
  }

 private:
  [[nodiscard]] std::uint64_t limit() const {
    return pieces_ + (is_decided(depth_, goal_) ? goal_.cells_decided : goal_.cells_undecided);
  }

  void evaluate(const std::array<Vec3d, 2>& end) {
    if (goal_.within && !box_of(end).meets(*goal_.within)) return;
    ++depth_.cells;
    const Vec3d middle = (end[0] + end[1]) * 0.5;
    const double radius = length(end[1] - end[0]) / 2, cutoff = depth_.value - radius;
    const auto on_a = boundary_a_.nearest(middle, ceiling_, cutoff);
    const auto on_b = boundary_b_.nearest(middle - shift_, on_a.distance, cutoff);
    const double d = on_b.distance;
    if (d <= cutoff) return;
    if (d > depth_.value && goal_.counts(middle)) {
      depth_.value = d;
      depth_.lower = std::max(0.0, d - kSlack);
      depth_.point = middle;
    }
    double upper = std::min(d + radius, ceiling_);
    if (on_b.distance < on_a.distance)
      upper = std::min(upper, farther_end(end, shift_, boundary_b_[on_b.segment]));
    else if (on_a.distance < ceiling_)
      upper = std::min(upper, farther_end(end, {}, boundary_a_[on_a.segment]));
    upper += kSlack;
    if (upper > depth_.value + 2 * kSlack) open_.push({end, upper, next_id_++});
  }

  /// The distance to a segment is convex: along another it is greatest at one of the ends.
  static double farther_end(const std::array<Vec3d, 2>& end, const Vec3d& shift,
                            const SegmentBvh::Segment& rim) {
    double largest = 0;
    for (const Vec3d& p : end) {
      const Vec3d q = p - shift;
      largest = std::max(largest, length(q - nearest_on_segment(q, rim[0], rim[1])));
    }
    return largest;
  }

  const SegmentBvh &boundary_a_, &boundary_b_;
  Vec3d shift_;
  double ceiling_;
  DepthOptions goal_;
  std::priority_queue<CurvePiece, std::vector<CurvePiece>, LessPromising> open_;
  Depth depth_;
  std::uint64_t pieces_ = 0;
  std::uint32_t next_id_ = 0;
};

}  // namespace

SheetCrossing::SheetCrossing(const PartWithBvh& a, const PartWithBvh& b, double apart_within,
                             QueryContext& work)
    : curves_(std::make_shared<const Curves>(a, b, apart_within, work)) {}

const std::vector<SheetCrossing::CrossingSegment>& SheetCrossing::crossing_segments() const {
  return curves_->crossing_segments;
}

Depth SheetCrossing::depth_along(std::span<const std::uint32_t> some, const DepthOptions& goal,
                                 QueryContext& work) const {
  const Curves& c = *curves_;
  if (!c.crossing.crosses) return {};
  CurveSearch search(c.boundary_a, c.boundary_b, c.shift, c.ceiling, goal);
  for (const std::uint32_t i : some) search.add(c.crossing.segments[i]);
  Depth depth = search.run(!c.crossing.truncated);
  work.triangle_pairs += depth.cells;
  depth.upper = std::max(depth.upper, depth.value);
  return depth;
}

Depth SheetCrossing::depth(const DepthOptions& goal, QueryContext& work) const {
  std::vector<std::uint32_t> all(crossing_segments().size());
  std::iota(all.begin(), all.end(), 0U);
  return depth_along(all, goal, work);
}

Depth sheet_crossing_depth(const PartWithBvh& a, const PartWithBvh& b, const DepthOptions& goal,
                           QueryContext& work) {
  return SheetCrossing(a, b, goal.apart_within, work).depth(goal, work);
}

}  // namespace strake::geometry
