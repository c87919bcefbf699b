// SPDX-License-Identifier: Apache-2.0
#include "strake/geometry/crossing_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "geometry/axis_rays.hpp"
#include "geometry/corner_index.hpp"
#include "geometry/crossing_pieces.hpp"
#include "geometry/one_side.hpp"
#include "geometry/pair_view.hpp"
#include "strake/geometry/intersect.hpp"
#include "strake/geometry/predicates.hpp"
#include "strake/geometry/triangle_contact.hpp"

namespace strake::geometry {
namespace {

/// A piece between grid points.
struct Stretch {
  Segment at;
  CrossingPiece of;
};

GridLine edge_of(const PartView& view, std::uint32_t triangle, int edge) {
  const TriangleCorners c = view.corners(triangle);
  return {c[at(edge)], c[at(next_corner(edge))], Reach::segment};
}

/// Where an edge of a triangle meets the plane of another.
Vec3l end_at(const TriangleCorners& of, const EdgeAtPlane& end, const TriangleCorners& plane) {
  const GridLine edge{of[at(end.from)], of[at(end.to)], Reach::segment};
  const Vec3<Int128> normal = cross_exact(plane[1] - plane[0], plane[2] - plane[0]);
  const auto height = [&](const Vec3l& p) { return dot(normal, (p - plane[0]).as<Int128>()); };
  const Int128 below = -height(edge.from), above = height(edge.to);
  return rounded_at(edge, {below, below + above});
}

/// What two triangles have in common that cross with their insides.
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

/// Of a stretch in the line of an edge.
std::optional<Segment> along_edge(const PartView& a, const PartView& b, const CrossingPiece& p) {
  if (p.edge_a >= 0 && p.edge_b >= 0) {
    const GridLine edge = edge_of(a, p.a, p.edge_a);
    const LineMeeting common = intersect(edge, edge_of(b, p.b, p.edge_b));
    if (common.touch != Touch::segment) return std::nullopt;
    return rounded(edge, common.first_a, common.last_a);
  }
  const GridLine edge = p.edge_a >= 0 ? edge_of(a, p.a, p.edge_a) : edge_of(b, p.b, p.edge_b);
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

/// The ends of a piece; nothing where it is no line, or one of faces that are meant to touch.
std::optional<Segment> ends_of(const PartView& a, const PartView& b, double flush,
                               const CrossingPiece& piece) {
  if (piece.edge_a >= 0 || piece.edge_b >= 0) return along_edge(a, b, piece);
  const ExactTriangle x = a.triangle(piece.a), y = b.triangle(piece.b);
  if (lies_along(x, y, flush) || lies_along(y, x, flush)) return std::nullopt;
  return within_both(x, y);
}

/// Each stretch once, ascending.
std::vector<Stretch> stretches_of(const PartView& a, const PartView& b, double flush,
                                  const std::vector<CrossingPiece>& pieces) {
  std::vector<Stretch> all;
  all.reserve(pieces.size());
  for (const CrossingPiece& piece : pieces) {
    std::optional<Segment> ends = ends_of(a, b, flush, piece);
    if (!ends || (*ends)[0] == (*ends)[1]) continue;
    if ((*ends)[1] < (*ends)[0]) std::swap((*ends)[0], (*ends)[1]);
    all.push_back({*ends, piece});
  }
  std::ranges::sort(all, [](const Stretch& x, const Stretch& y) {
    return std::tie(x.at, x.of.a, x.of.b, x.of.edge_a, x.of.edge_b) <
           std::tie(y.at, y.of.a, y.of.b, y.of.edge_a, y.of.edge_b);
  });
  const auto same = std::ranges::unique(all, {}, &Stretch::at);
  all.erase(same.begin(), same.end());
  return all;
}

bool lies_in(const TriangleCorners& t, const ExactTriangle& plane) {
  return std::ranges::all_of(t, [&](const Vec3l& p) { return plane.plane.side(p) == 0; });
}

/// A triangle, or all that are round an edge of it.
std::span<const std::uint32_t> triangles_at(const PartView& view, const std::uint32_t& triangle,
                                            int edge) {
  if (edge < 0) return {&triangle, 1};
  return star(view.part(), triangle, edge);
}

/// The planes of a part that two pieces share, each as one of its triangles.
std::vector<ExactTriangle> shared_planes(const PartView& view, std::span<const std::uint32_t> x,
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

/// Stretches joined end to end where just two meet that share both planes: these are one line.
class Joiner {
 public:
  Joiner(const PartView& a, const PartView& b, std::vector<Stretch> stretches)
      : a_(a), b_(b), all_(std::move(stretches)), next_(2 * all_.size(), kEnd) {
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

  // The ends of stretch i have the numbers 2i and 2i + 1.
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
    const CrossingPiece &s = all_[x / 2].of, &t = all_[y / 2].of;
    const auto of_a =
        shared_planes(a_, triangles_at(a_, s.a, s.edge_a), triangles_at(a_, t.a, t.edge_a));
    const auto of_b =
        shared_planes(b_, triangles_at(b_, s.b, s.edge_b), triangles_at(b_, t.b, t.edge_b));
    // Where the planes are two they have one line in common; where the skins lie on each other they
    // may be one.
    const bool collinear = std::ranges::any_of(of_a, [&](const ExactTriangle& plane) {
      return std::ranges::any_of(
          of_b, [&](const ExactTriangle& other) { return !lies_in(other.corner, plane); });
    });
    if (!collinear) return;
    next_[x] = y;
    next_[y] = x;
  }

  const PartView &a_, &b_;
  std::vector<Stretch> all_;
  std::vector<std::size_t> next_;  ///< by end: the end that goes on from there
};

std::vector<Segment> lines_of(const PartView& a, const PartView& b, std::int64_t flush,
                              const std::vector<CrossingPiece>& pieces) {
  return Joiner(a, b, stretches_of(a, b, static_cast<double>(flush), pieces)).run();
}

}  // namespace

std::optional<std::vector<Segment>> crossing_lines_up_to(std::size_t most, const FramedPart& a,
                                                         const FramedPart& b, std::int64_t flush,
                                                         PairWork& work) {
  const PartView x({a.placed, a.tree}, {});
  const PartView y({b.placed, b.tree}, b.placed.origin - a.placed.origin);
  if (lies_on_one_side(x, y) || lies_on_one_side(y, x)) return std::vector<Segment>{};
  const CrossingPieces pieces = crossing_pieces(a, b, most, work);
  if (pieces.truncated) return std::nullopt;
  return lines_of(x, y, flush, pieces.all);
}

std::vector<Segment> crossing_lines(const FramedPart& a, const FramedPart& b, std::int64_t flush,
                                    PairWork& work) {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  return crossing_lines_up_to(kAll, a, b, flush, work).value_or(std::vector<Segment>{});
}

std::vector<Segment> crossing_lines_all(const PlacedPart& a, const PlacedPart& b,
                                        std::int64_t flush, PairWork& work) {
  const PartView x({a, nullptr}, {}), y({b, nullptr}, b.origin - a.origin);
  return lines_of(x, y, flush, crossing_pieces_all(a, b, work));
}

}  // namespace strake::geometry
