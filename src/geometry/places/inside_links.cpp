// SPDX-License-Identifier: Apache-2.0
#include "geometry/places/inside_links.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

#include "geometry/depth/depth_field.hpp"
#include "geometry/places/segment_near.hpp"

// Between two stops that follow each other on a line the line stays on one side of the other skin.
// So each stretch asks for the side of one point, and only where its ends are not joined yet.
//
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
  InsideLinks(const PlacesSide& side, const TreedPart& other, std::span<const NearTriangles> pairs,
              double reach, const InsideSets& sets, PairWork& work)
      : side_(side),
        other_(other, Vec3l{} - side.other.shift()),
        pairs_(pairs),
        squared_(reach * reach),
        sets_(sets.sets),
        first_vertex_(sets.first_vertex),
        work_(work),
        inside_(side.own.part().vertices.size(), Known::no) {}

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
      join_vertex(e.v0, stops[first].pair);
      stretches(place(e.v0), place(e.v1), std::span(stops).subspan(first, last - first));
      join_vertex(e.v1, stops[last - 1].pair);
      first = last;
    }
  }

  void across_triangles() {
    std::vector<std::uint32_t> order(pairs_.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    std::ranges::sort(order, [&](std::uint32_t i, std::uint32_t j) {
      return std::pair(side_.own_of(pairs_[i]), i) < std::pair(side_.own_of(pairs_[j]), j);
    });
    for (std::size_t first = 0; first < order.size();) {
      std::size_t last = first;
      while (last < order.size() &&
             side_.own_of(pairs_[order[last]]) == side_.own_of(pairs_[order[first]]))
        ++last;
      across_triangle(std::span(order).subspan(first, last - first));
      first = last;
    }
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

  /// A vertex and the stop next to it.
  void join_vertex(std::uint32_t vertex, std::uint32_t pair) {
    const std::uint32_t member = first_vertex_ + vertex;
    if (sets_.joined(member, pair)) return;
    // Vertices are joined with one another and inside the other body with pairs, so that all of a
    // set without pairs lie on one side; any of them tells.
    const std::uint32_t root = sets_.root(member);
    Known& known = inside_[root >= first_vertex_ && root - first_vertex_ < inside_.size()
                               ? root - first_vertex_
                               : vertex];
    if (known == Known::no)
      known = other_.side(place(vertex), work_) == PointSide::inside ? Known::inside
                                                                     : Known::not_inside;
    if (known == Known::inside) sets_.join(member, pair);
  }

  void stretches(const Vec3d& from, const Vec3d& to, std::span<const EdgeStop> stops) {
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const EdgeStop &s = stops[i], &t = stops[i + 1];
      if (!(s.along < t.along) || sets_.joined(s.pair, t.pair)) continue;
      const Vec3d middle = from + (to - from) * ((s.along + t.along) / 2);
      if (other_.side(on_field_grid(middle), work_) == PointSide::inside)
        sets_.join(s.pair, t.pair);
    }
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
    const NearTriangles& p = pairs_[start];
    const auto own = side_.own.corners(side_.own_of(p));
    ++work_.exact_fallbacks;
    const Vec3d from =
        exact_distance(own, side_.other.corners(side_.other_of(p)), p.squared.upper).on_a;
    const std::uint32_t corner = side_.own.part().triangles[side_.own_of(p)][0];
    const Vec3d to = place(corner);
    std::vector<EdgeStop> stops;
    for (const std::uint32_t i : pairs) {
      const SegmentNear near =
          nearest_along(from, to, as_doubles(side_.other.corners(side_.other_of(pairs_[i]))));
      if (near.squared <= squared_) stops.push_back({0, 0, i, near.along});
    }
    std::ranges::sort(stops, [](const EdgeStop& x, const EdgeStop& y) {
      return std::tie(x.along, x.pair) < std::tie(y.along, y.pair);
    });
    if (stops.empty()) return;
    stretches(from, to, stops);
    join_vertex(corner, stops.back().pair);
  }

  const PlacesSide& side_;
  DepthField other_;
  std::span<const NearTriangles> pairs_;
  double squared_;
  DisjointSets& sets_;
  std::uint32_t first_vertex_;
  PairWork& work_;
  std::vector<Known> inside_;          ///< by vertex: its set's side, where asked for
  std::vector<std::uint32_t> starts_;  ///< a pair of each set in a triangle
};

}  // namespace

void link_inside(const PlacesSide& side, const TreedPart& other,
                 std::span<const NearTriangles> pairs, std::vector<EdgeStop> stops, double reach,
                 const InsideSets& sets, PairWork& work) {
  InsideLinks links(side, other, pairs, reach, sets, work);
  links.along_edges(std::move(stops));
  links.across_triangles();
}

}  // namespace strake::geometry
