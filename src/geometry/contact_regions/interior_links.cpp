// SPDX-License-Identifier: Apache-2.0
#include "geometry/contact_regions/interior_links.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/contact_regions/edge_hits.hpp"
#include "geometry/interior_depth/surface_distance/nearest_triangle.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {

std::vector<EdgeHit> InteriorSegments::hits_on(const ParamLine& line,
                                               std::span<const std::uint32_t> listed,
                                               double squared) const {
  const RegionSide& side = near_.side;
  std::vector<EdgeHit> stops;
  for (const std::uint32_t i : listed) {
    const Corners t = as_doubles(side.other.corners(side.other_of(near_.pairs[i])));
    if (const std::optional<double> along = nearest_parameter(line.from, line.to, t, squared))
      stops.push_back({0, 0, i, *along});
  }
  std::ranges::sort(stops, [](const EdgeHit& x, const EdgeHit& y) {
    return std::tie(x.along, x.pair) < std::tie(y.along, y.pair);
  });
  return stops;
}

std::size_t InteriorSegments::join(const ParamLine& line, std::span<const EdgeHit> stops) {
  std::size_t joins = 0;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const EdgeHit &s = stops[i], &t = stops[i + 1];
    if (!(s.along < t.along) || sets_.joined(s.pair, t.pair)) continue;
    if (!is_inside(line.at((s.along + t.along) / 2))) continue;
    const std::uint32_t from = first_at_line(line.at(s.along), s.pair);
    joins += sets_.join(from, first_at_line(line.at(t.along), t.pair)) ? 1U : 0U;
  }
  return joins;
}

std::uint32_t InteriorSegments::first_at_line(const Vec3d& from, std::uint32_t pair) const {
  const RegionSide& side = near_.side;
  const Corners t = as_doubles(side.other.corners(side.other_of(near_.pairs[pair])));
  const ParamLine line{from, nearest_on_triangle(from, t)};
  const Vec3d gap = line.to - from;
  if (dot(gap, gap) <= kMeets * kMeets) return pair;
  const auto stops = hits_on(line, near_.own.group(near_.own.row[pair]), kMeets * kMeets);
  return stops.empty() ? pair : stops.front().pair;
}

}  // namespace strake::geometry

// The surface inside the other body falls into pieces. The part of a piece in one triangle has one
// outer border and any number of holes. Borders are connected through the edges of the triangles; a
// hole need not touch any (a tube through a plate leaves a ring in it: both its circles may lie in
// the middle of one triangle). A line from each hole to a corner of the triangle leaves the hole
// through the piece round it, so it is joined to whatever bounds the piece there: another hole,
// whose own line continues, or the outer border.

namespace strake::geometry {
namespace {

class InsideLinks {
 public:
  InsideLinks(const NearSolid& near, const InteriorSets& sets, QueryContext& work)
      : side_(near.side),
        near_(near),
        sets_(sets.sets),
        first_vertex_(sets.first_vertex),
        work_(work),
        interior_segments_(near, sets.sets, work),
        inside_(near.side.own.part().vertices.size(), Known::no) {}

  void along_edges(std::vector<EdgeHit> stops) {
    std::ranges::sort(stops, [](const EdgeHit& x, const EdgeHit& y) {
      return std::tie(x.edge, x.along, x.pair) < std::tie(y.edge, y.along, y.pair);
    });
    join_free_edges(stops);
    const Part& part = side_.own.part();
    for (std::size_t first = 0; first < stops.size();) {
      std::size_t last = first;
      while (last < stops.size() && stops[last].edge == stops[first].edge) ++last;
      const PartEdge& e = part.edges[stops[first].edge];
      const ParamLine line{place(e.v0), place(e.v1)};
      join_vertex(e.v0, stops[first], line);
      interior_segments_.join(line, std::span(stops).subspan(first, last - first));
      join_vertex(e.v1, stops[last - 1], line);
      first = last;
    }
  }

  void across_triangles() {
    for (std::size_t r = 0; r + 1 < near_.own.first.size(); ++r)
      across_triangle(near_.own.group(r));
  }

 private:
  enum class Known : std::uint8_t { no, inside, not_inside };

  [[nodiscard]] Vec3d place(std::uint32_t vertex) const {
    return side_.own.vertex(vertex).as<double>();
  }

  /// Unites the ends of edges far from the other surface, which lie on one side of it.
  void join_free_edges(const std::vector<EdgeHit>& stops) {
    const Part& part = side_.own.part();
    std::size_t next = 0;
    for (std::uint32_t e = 0; e + 1 < part.edges.size(); ++e) {
      while (next < stops.size() && stops[next].edge < e) ++next;
      if (next < stops.size() && stops[next].edge == e) continue;
      sets_.join(first_vertex_ + part.edges[e].v0, first_vertex_ + part.edges[e].v1);
    }
  }

  /// Unites a vertex and the hit next to it on a line.
  void join_vertex(std::uint32_t vertex, const EdgeHit& stop, const ParamLine& line) {
    const std::uint32_t member = first_vertex_ + vertex;
    if (sets_.joined(member, stop.pair)) return;
    // Vertices are joined with one another and inside the other body with pairs, so that all of a
    // set without pairs lie on one side; any of them decides.
    const std::uint32_t root = sets_.root(member);
    Known& known = inside_[root >= first_vertex_ && root - first_vertex_ < inside_.size()
                               ? root - first_vertex_
                               : vertex];
    if (known == Known::no)
      known = interior_segments_.is_inside(place(vertex)) ? Known::inside : Known::not_inside;
    if (known == Known::inside)
      sets_.join(member, interior_segments_.first_at_line(line.at(stop.along), stop.pair));
  }

  void across_triangle(std::span<const std::uint32_t> pairs) {
    std::vector<std::uint32_t> roots;
    for (const std::uint32_t i : pairs) {
      const std::uint32_t root = sets_.root(i);
      if (std::ranges::find(roots, root) != roots.end()) continue;
      roots.push_back(root);
      if (roots.size() == 1) starts_.clear();
      starts_.push_back(i);
    }
    if (roots.size() < 2) return;
    for (const std::uint32_t start : starts_) line_to_corner(start, pairs);
  }

  /// Follows the line from where the two triangles of a pair are nearest to a corner of the side's
  /// triangle.
  void line_to_corner(std::uint32_t start, std::span<const std::uint32_t> pairs) {
    const NearTrianglePair& p = near_.pairs[start];
    const auto own = side_.own.corners(side_.own_of(p));
    ++work_.exact_fallbacks;
    const Vec3d from =
        exact_triangle_distance(own, side_.other.corners(side_.other_of(p)), p.squared.upper).on_a;
    const std::uint32_t corner = side_.own.part().triangles[side_.own_of(p)][0];
    const ParamLine line{from, place(corner)};
    const std::vector<EdgeHit> stops =
        interior_segments_.hits_on(line, pairs, near_.squared_reach());
    if (stops.empty()) return;
    interior_segments_.join(line, stops);
    join_vertex(corner, stops.back(), line);
  }

  const RegionSide& side_;
  NearSolid near_;
  UnionFind& sets_;
  std::uint32_t first_vertex_;
  QueryContext& work_;
  InteriorSegments interior_segments_;
  std::vector<Known> inside_;          ///< by vertex: its set's side, where requested
  std::vector<std::uint32_t> starts_;  ///< a pair of each set in a triangle
};

}  // namespace

void unite_through_interior(const NearSolid& near, const InteriorSets& sets, QueryContext& work) {
  InsideLinks links(near, sets, work);
  links.along_edges(edge_hits(near.side, near.own, near.pairs, near.reach));
  links.across_triangles();
}

}  // namespace strake::geometry

// The points of the other body within reach of a point x on the one surface are those in a ball
// round x. The other surface cuts the ball into pieces, and a segment between two points in the
// ball stays in it: along it pieces of surface follow each other, and those with material between
// them bound the same piece of the body. Since each piece of surface divides the ball in two, all
// boundaries of one piece of material are found along lines from any of them to the others.

namespace strake::geometry {
namespace {

/// Number of points tried for each set that a triangle is in.
constexpr std::size_t kTries = 8;

class MaterialLinks {
 public:
  MaterialLinks(const NearSolid& near, UnionFind& sets, QueryContext& work)
      : near_(near), sets_(sets), work_(work), interior_segments_(near, sets, work) {}

  /// The pairs of one triangle.
  std::size_t join(std::span<const std::uint32_t> group) {
    if (std::ranges::all_of(group, [&](std::uint32_t i) { return sets_.joined(group[0], i); }))
      return 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_set;
    for (const std::uint32_t i : group) by_set.emplace_back(sets_.root(i), i);
    std::ranges::sort(by_set);
    std::size_t joins = 0;
    for (std::size_t first = 0; first < by_set.size();) {
      std::size_t last = first;
      while (last < by_set.size() && by_set[last].first == by_set[first].first) ++last;
      const std::size_t size = last - first, tries = std::min(size, kTries);
      for (std::size_t k = 0; k < tries; ++k)
        joins += join_round(by_set[first + k * size / tries].second, group);
      first = last;
    }
    return joins;
  }

 private:
  /// Where another set of pairs comes near a point.
  struct Spot {
    std::uint32_t root = 0;
    double squared = 0;
    std::uint32_t pair = 0;
    Vec3d at;
  };

  [[nodiscard]] TriangleCorners other_corners(std::uint32_t pair) const {
    return near_.side.other.corners(near_.side.other_of(near_.pairs[pair]));
  }

  /// Returns, for each set that the pair is not in, the spot nearest to x, within reach of it.
  [[nodiscard]] std::vector<Spot> spots_round(const Vec3d& x, std::uint32_t pair,
                                              std::span<const std::uint32_t> group) const {
    std::vector<Spot> spots;
    for (const std::uint32_t i : group) {
      if (sets_.joined(pair, i)) continue;
      const Corners t = as_doubles(other_corners(i));
      if (squared_gap({x, x}, box_of(t)) > near_.squared_reach()) continue;
      const Vec3d at = nearest_on_triangle(x, t), gap = at - x;
      if (dot(gap, gap) <= near_.squared_reach())
        spots.push_back({sets_.root(i), dot(gap, gap), i, at});
    }
    std::ranges::sort(spots, [](const Spot& s, const Spot& t) {
      return std::tie(s.root, s.squared, s.pair) < std::tie(t.root, t.squared, t.pair);
    });
    const auto rest = std::ranges::unique(spots, {}, &Spot::root);
    spots.erase(rest.begin(), rest.end());
    return spots;
  }

  /// Unites round the point of the own triangle that is nearest to the other triangle of a pair.
  std::size_t join_round(std::uint32_t pair, std::span<const std::uint32_t> group) {
    ++work_.exact_fallbacks;
    const NearTrianglePair& p = near_.pairs[pair];
    const NearestTrianglePoints nearest = exact_triangle_distance(
        near_.side.own.corners(near_.side.own_of(p)), other_corners(pair), p.squared.upper);
    std::size_t joins = 0;
    for (const Spot& spot : spots_round(nearest.on_a, pair, group)) {
      const ParamLine line{nearest.on_b, spot.at};
      constexpr double kMeets = InteriorSegments::kMeets;
      joins +=
          interior_segments_.join(line, interior_segments_.hits_on(line, group, kMeets * kMeets));
    }
    return joins;
  }

  NearSolid near_;
  UnionFind& sets_;
  QueryContext& work_;
  InteriorSegments interior_segments_;
};

}  // namespace

std::size_t unite_through_material(const NearSolid& near, UnionFind& sets, QueryContext& work) {
  MaterialLinks links(near, sets, work);
  std::size_t joins = 0;
  for (std::size_t r = 0; r + 1 < near.own.first.size(); ++r)
    joins += links.join(near.own.group(r));
  return joins;
}

}  // namespace strake::geometry
