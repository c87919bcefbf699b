// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/inside_links.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

#include "geometry/places/stretches.hpp"

// The skin inside the other body falls into pieces. What of a piece lies in one triangle has one
// outer rim and any number of holes. Rims hang together through the edges of the triangles; a hole
// need not touch any (a tube through a plate leaves a ring in it: both its circles may lie in the
// middle of one triangle). A line from each hole to a corner of the triangle leaves the hole
// through the piece round it, so it is joined to whatever bounds the piece there: another hole,
// whose own line goes on, or the rim.

namespace strake::geometry {
namespace {

class InsideLinks {
 public:
  InsideLinks(const SolidNear& near, const InsideSets& sets, PairWork& work)
      : side_(near.side),
        near_(near),
        sets_(sets.sets),
        first_vertex_(sets.first_vertex),
        work_(work),
        stretches_(near, sets.sets, work),
        inside_(near.side.own.part().vertices.size(), Known::no) {}

  void along_edges(std::vector<EdgeStop> stops) {
    std::ranges::sort(stops, [](const EdgeStop& x, const EdgeStop& y) {
      return std::tie(x.edge, x.along, x.pair) < std::tie(y.edge, y.along, y.pair);
    });
    join_free_edges(stops);
    const Part& part = side_.own.part();
    for (std::size_t first = 0; first < stops.size();) {
      std::size_t last = first;
      while (last < stops.size() && stops[last].edge == stops[first].edge) ++last;
      const PartEdge& e = part.edges[stops[first].edge];
      const Line line{place(e.v0), place(e.v1)};
      join_vertex(e.v0, stops[first], line);
      stretches_.join(line, std::span(stops).subspan(first, last - first));
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

  /// Edges far from the other skin: their ends lie on one side of it.
  void join_free_edges(const std::vector<EdgeStop>& stops) {
    const Part& part = side_.own.part();
    std::size_t next = 0;
    for (std::uint32_t e = 0; e + 1 < part.edges.size(); ++e) {
      while (next < stops.size() && stops[next].edge < e) ++next;
      if (next < stops.size() && stops[next].edge == e) continue;
      sets_.join(first_vertex_ + part.edges[e].v0, first_vertex_ + part.edges[e].v1);
    }
  }

  /// A vertex and the stop next to it on a line.
  void join_vertex(std::uint32_t vertex, const EdgeStop& stop, const Line& line) {
    const std::uint32_t member = first_vertex_ + vertex;
    if (sets_.joined(member, stop.pair)) return;
    // Vertices are joined with one another and inside the other body with pairs, so that all of a
    // set without pairs lie on one side; any of them tells.
    const std::uint32_t root = sets_.root(member);
    Known& known = inside_[root >= first_vertex_ && root - first_vertex_ < inside_.size()
                               ? root - first_vertex_
                               : vertex];
    if (known == Known::no)
      known = stretches_.is_inside(place(vertex)) ? Known::inside : Known::not_inside;
    if (known == Known::inside)
      sets_.join(member, stretches_.first_seen(line.at(stop.along), stop.pair));
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

  /// From where the two triangles of a pair are nearest to a corner of the side's.
  void line_to_corner(std::uint32_t start, std::span<const std::uint32_t> pairs) {
    const NearTriangles& p = near_.pairs[start];
    const auto own = side_.own.corners(side_.own_of(p));
    ++work_.exact_fallbacks;
    const Vec3d from =
        exact_distance(own, side_.other.corners(side_.other_of(p)), p.squared.upper).on_a;
    const std::uint32_t corner = side_.own.part().triangles[side_.own_of(p)][0];
    const Line line{from, place(corner)};
    const std::vector<EdgeStop> stops = stretches_.stops_on(line, pairs, near_.squared_reach());
    if (stops.empty()) return;
    stretches_.join(line, stops);
    join_vertex(corner, stops.back(), line);
  }

  const PlacesSide& side_;
  SolidNear near_;
  DisjointSets& sets_;
  std::uint32_t first_vertex_;
  PairWork& work_;
  Stretches stretches_;
  std::vector<Known> inside_;          ///< by vertex: its set's side, where asked for
  std::vector<std::uint32_t> starts_;  ///< a pair of each set in a triangle
};

}  // namespace

void link_inside(const SolidNear& near, const InsideSets& sets, PairWork& work) {
  InsideLinks links(near, sets, work);
  links.along_edges(edge_stops(near.side, near.own, near.pairs, near.reach));
  links.across_triangles();
}

}  // namespace strake::geometry
