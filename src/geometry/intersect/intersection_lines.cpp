// SPDX-License-Identifier: Apache-2.0
#include "geometry/intersect/intersection_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "geometry/bvh/pair_local_part.hpp"
#include "geometry/intersect/intersection_segments.hpp"
#include "geometry/intersect/radial_sort.hpp"
#include "geometry/intersect/separating_plane.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "strake/geometry/intersect.hpp"
#include "strake/geometry/predicates.hpp"
#include "strake/geometry/triangle_contact.hpp"

namespace strake::geometry {
namespace {

/// A piece between grid points.
struct GridSegment {
  Segment at;
  IntersectionSegment of;
};

GridLine line_end_edge(const PairLocalPart& view, std::uint32_t triangle, int edge) {
  const TriangleCorners c = view.corners(triangle);
  return {c[at(edge)], c[at(next_corner(edge))], LineKind::segment};
}

/// Returns where an edge of a triangle meets the plane of another.
Vec3l end_at(const TriangleCorners& of, const EdgeAtPlane& end, const TriangleCorners& plane) {
  const GridLine edge{of[at(end.from)], of[at(end.to)], LineKind::segment};
  const Vec3<Int128> normal = cross_exact(plane[1] - plane[0], plane[2] - plane[0]);
  const auto height = [&](const Vec3l& p) { return dot(normal, (p - plane[0]).as<Int128>()); };
  const Int128 below = -height(edge.from), above = height(edge.to);
  return rounded_at(edge, {below, below + above});
}

/// Returns the common segment of two triangles whose interiors cross.
Segment within_both(const ExactTriangle& a, const ExactTriangle& b) {
  Segment ends;
  std::ranges::transform(
      segment_ends(a, b, contact(a, b)), ends.begin(), [&](const EdgeAtPlane& end) {
        return end.of_b ? end_at(b.corner, end, a.corner) : end_at(a.corner, end, b.corner);
      });
  return ends;
}

Segment rounded(const GridLine& line, const Rational& from, const Rational& to) {
  return {rounded_at(line, from), rounded_at(line, to)};
}

/// Returns the common segment on the line of an edge.
std::optional<Segment> along_edge(const PairLocalPart& a, const PairLocalPart& b,
                                  const IntersectionSegment& p) {
  if (p.edge_a >= 0 && p.edge_b >= 0) {
    const GridLine edge = line_end_edge(a, p.a, p.edge_a);
    const LineMeeting common = intersect(edge, line_end_edge(b, p.b, p.edge_b));
    if (common.touch != Touch::segment) return std::nullopt;
    return rounded(edge, common.first_a, common.last_a);
  }
  const GridLine edge =
      p.edge_a >= 0 ? line_end_edge(a, p.a, p.edge_a) : line_end_edge(b, p.b, p.edge_b);
  const LineInTriangle common = intersect(edge, p.edge_a >= 0 ? b.corners(p.b) : a.corners(p.a));
  if (common.at.touch != Touch::segment) return std::nullopt;
  return rounded(edge, common.at.first, common.at.last);
}

/// Whether a triangle lies within a distance of another's plane.
bool lies_along(const ExactTriangle& t, const ExactTriangle& other, double distance) {
  const Vec3d n = other.plane.normal();
  const double reach = distance * std::sqrt(dot(n, n));
  return std::ranges::all_of(t.corner, [&](const Vec3l& p) {
    return std::fabs(dot(n, (p - other.corner[0]).as<double>())) <= reach;
  });
}

/// Returns the ends of a segment; nothing where it is a point, or one of faces that are meant to
/// touch.
std::optional<Segment> ends_of(const PairLocalPart& a, const PairLocalPart& b, double flush,
                               const IntersectionSegment& piece) {
  if (piece.edge_a >= 0 || piece.edge_b >= 0) return along_edge(a, b, piece);
  const ExactTriangle x = a.triangle(piece.a), y = b.triangle(piece.b);
  if (lies_along(x, y, flush) || lies_along(y, x, flush)) return std::nullopt;
  return within_both(x, y);
}

/// Returns the segments, sorted and without duplicates.
std::vector<GridSegment> grid_segments_of(const PairLocalPart& a, const PairLocalPart& b,
                                          double flush,
                                          const std::vector<IntersectionSegment>& pieces) {
  std::vector<GridSegment> all;
  all.reserve(pieces.size());
  for (const IntersectionSegment& piece : pieces) {
    std::optional<Segment> ends = ends_of(a, b, flush, piece);
    if (!ends || (*ends)[0] == (*ends)[1]) continue;
    if ((*ends)[1] < (*ends)[0]) std::swap((*ends)[0], (*ends)[1]);
    all.push_back({*ends, piece});
  }
  std::ranges::sort(all, [](const GridSegment& x, const GridSegment& y) {
    return std::tie(x.at, x.of.a, x.of.b, x.of.edge_a, x.of.edge_b) <
           std::tie(y.at, y.of.a, y.of.b, y.of.edge_a, y.of.edge_b);
  });
  const auto same = std::ranges::unique(all, {}, &GridSegment::at);
  all.erase(same.begin(), same.end());
  return all;
}

bool lies_in(const TriangleCorners& t, const ExactTriangle& plane) {
  return std::ranges::all_of(t, [&](const Vec3l& p) { return plane.plane.side(p) == 0; });
}

/// Returns a triangle, or all triangles at an edge of it.
std::span<const std::uint32_t> triangles_at(const PairLocalPart& view,
                                            const std::uint32_t& triangle, int edge) {
  if (edge < 0) return {&triangle, 1};
  return edge_star(view.part(), triangle, edge);
}

/// Returns the planes of a part that two segments share, each as one of its triangles.
std::vector<ExactTriangle> shared_planes(const PairLocalPart& view,
                                         std::span<const std::uint32_t> x,
                                         std::span<const std::uint32_t> y) {
  std::vector<ExactTriangle> shared;
  for (const std::uint32_t t : x) {
    const ExactTriangle plane = view.triangle(t);
    if (std::ranges::any_of(
            y, [&](std::uint32_t u) { return u == t || lies_in(view.corners(u), plane); }))
      shared.push_back(plane);
  }
  return shared;
}

/// Joins segments end to end where just two meet that share both planes: these are one line.
class Joiner {
 public:
  Joiner(const PairLocalPart& a, const PairLocalPart& b, std::vector<GridSegment> segments)
      : a_(a), b_(b), all_(std::move(segments)), next_(2 * all_.size(), kEnd) {
    link();
  }

  [[nodiscard]] std::vector<Segment> run() const {
    std::vector<Segment> lines;
    for (std::size_t from = 0; from < next_.size(); ++from) {
      if (next_[from] != kEnd) continue;
      std::size_t to = other(from);
      while (next_[to] != kEnd) to = other(next_[to]);
      // Each line is met from either end.
      if (point(from) < point(to)) lines.push_back({point(from), point(to)});
    }
    std::ranges::sort(lines);
    return lines;
  }

 private:
  static constexpr std::size_t kEnd = std::numeric_limits<std::size_t>::max();

  // The ends of segment i have the numbers 2i and 2i + 1.
  static std::size_t other(std::size_t end) { return end ^ 1U; }
  [[nodiscard]] const Vec3l& point(std::size_t end) const { return all_[end / 2].at[end % 2]; }

  void link() {
    std::vector<std::size_t> ends(next_.size());
    for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = i;
    std::ranges::sort(ends, [&](std::size_t x, std::size_t y) {
      return point(x) != point(y) ? point(x) < point(y) : x < y;
    });
    for (std::size_t i = 0; i < ends.size();) {
      std::size_t last = i + 1;
      while (last < ends.size() && point(ends[last]) == point(ends[i])) ++last;
      if (last == i + 2) link(ends[i], ends[i + 1]);
      i = last;
    }
  }

  void link(std::size_t x, std::size_t y) {
    const IntersectionSegment &s = all_[x / 2].of, &t = all_[y / 2].of;
    const auto of_a =
        shared_planes(a_, triangles_at(a_, s.a, s.edge_a), triangles_at(a_, t.a, t.edge_a));
    const auto of_b =
        shared_planes(b_, triangles_at(b_, s.b, s.edge_b), triangles_at(b_, t.b, t.edge_b));
    // Two different planes have one line in common; where the surfaces overlap they may be one
    // plane.
    const bool collinear = std::ranges::any_of(of_a, [&](const ExactTriangle& plane) {
      return std::ranges::any_of(
          of_b, [&](const ExactTriangle& other) { return !lies_in(other.corner, plane); });
    });
    if (!collinear) return;
    next_[x] = y;
    next_[y] = x;
  }

  const PairLocalPart &a_, &b_;
  std::vector<GridSegment> all_;
  std::vector<std::size_t> next_;  ///< by end: the end that continues from there
};

std::vector<Segment> lines_of(const PairLocalPart& a, const PairLocalPart& b, std::int64_t flush,
                              const std::vector<IntersectionSegment>& pieces) {
  return Joiner(a, b, grid_segments_of(a, b, static_cast<double>(flush), pieces)).run();
}

}  // namespace

std::optional<std::vector<Segment>> part_intersection_lines_up_to(std::size_t limit,
                                                                  const PartWithObb& a,
                                                                  const PartWithObb& b,
                                                                  std::int64_t flush,
                                                                  QueryContext& work) {
  const PairLocalPart x({a.placed, a.tree}, {});
  const PairLocalPart y({b.placed, b.tree}, b.placed.origin - a.placed.origin);
  if (lies_on_one_side(x, y) || lies_on_one_side(y, x)) return std::vector<Segment>{};
  const IntersectionSegments pieces = find_intersection_segments(a, b, limit, work);
  if (pieces.truncated) return std::nullopt;
  return lines_of(x, y, flush, pieces.all);
}

std::vector<Segment> part_intersection_lines(const PartWithObb& a, const PartWithObb& b,
                                             std::int64_t flush, QueryContext& work) {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  return part_intersection_lines_up_to(kAll, a, b, flush, work).value_or(std::vector<Segment>{});
}

std::vector<Segment> part_intersection_lines_brute_force(const PlacedPart& a, const PlacedPart& b,
                                                         std::int64_t flush, QueryContext& work) {
  const PairLocalPart x({a, nullptr}, {}), y({b, nullptr}, b.origin - a.origin);
  return lines_of(x, y, flush, find_intersection_segments_brute_force(a, b, work));
}

}  // namespace strake::geometry
