// SPDX-License-Identifier: Apache-2.0
#include "geometry/contact_regions/edge_hits.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "geometry/contact_regions/counting_sort.hpp"
#include "geometry/distance/elementary_distance.hpp"
#include "geometry/interior_depth/surface_distance/nearest_triangle.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {
namespace {

struct NearestParameter {
  double squared = std::numeric_limits<double>::infinity();
  double along = 0;
};

}  // namespace

std::optional<double> nearest_parameter(const Vec3d& from, const Vec3d& to, const Corners& t,
                                        double squared_reach) {
  if (squared_gap(box_of(std::array{from, to}), box_of(t)) > squared_reach) return std::nullopt;
  const Vec3d n = normal_of(t), d = to - from;
  const std::array<double, 2> height{dot(n, from - t[0]), dot(n, to - t[0])};
  if ((height[0] <= 0 && height[1] >= 0) || (height[0] >= 0 && height[1] <= 0)) {
    const double s = height[0] == height[1] ? 0 : height[0] / (height[0] - height[1]);
    if (projects_inside(from + d * s, t, n)) return s;
  }
  NearestParameter best;
  // For a segment without length only the ends count: a NaN never compares less.
  const auto offer = [&](const NearestParameter& near) {
    if (near.squared < best.squared) best = near;
  };
  for (const double end : {0.0, 1.0}) {
    const Vec3d p = end > 0 ? to : from;
    offer({squared_length(p - nearest_on_triangle(p, t)), end});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d edge = t[(i + 1) % 3] - t[i];
    const auto [on_d, on_edge] = closest_on_segments(from, d, t[i], edge);
    offer({squared_length(from - t[i] + d * on_d - edge * on_edge), on_d});
  }
  if (best.squared > squared_reach) return std::nullopt;
  return best.along;
}

namespace {

std::optional<double> near_along_edge(const PairLocalPart& view, std::uint32_t edge,
                                      const Corners& t, double squared) {
  const PartEdge& e = view.part().edges[edge];
  return nearest_parameter(view.vertex(e.v0).as<double>(), view.vertex(e.v1).as<double>(), t,
                           squared);
}

/// A feature of another triangle, and the pair that has it.
struct SharedFeature {
  std::uint32_t id = 0, pair = 0;
};

/// Unites the pairs of each feature that passes; tests only pairs not united yet.
template <class Near>
std::size_t join_features(std::vector<SharedFeature>& features, UnionFind& sets, const Near& near) {
  std::size_t joins = 0;
  std::ranges::sort(features, [](const SharedFeature& x, const SharedFeature& y) {
    return std::tie(x.id, x.pair) < std::tie(y.id, y.pair);
  });
  for (std::size_t first = 0; first < features.size();) {
    std::size_t last = first + 1;
    bool apart = false;
    for (; last < features.size() && features[last].id == features[first].id; ++last)
      apart = apart || !sets.joined(features[first].pair, features[last].pair);
    if (apart && near(features[first].id))
      for (std::size_t i = first + 1; i < last; ++i)
        joins += sets.join(features[first].pair, features[i].pair) ? 1U : 0U;
    first = last;
  }
  return joins;
}

}  // namespace

PairsByTriangle grouped(const RegionSide& side, std::span<const NearTrianglePair> pairs) {
  PairsByTriangle side_pairs;
  side_pairs.order = index_sequence(pairs.size());
  side_pairs.row.resize(pairs.size());
  const Part& part = side.own.part();
  if (!side.is_a)  // the pairs are by (a, b)
    counting_sort(side_pairs.order, part.triangles.size(),
                  [&](std::uint32_t i) { return pairs[i].b; });
  for (std::uint32_t k = 0; k < side_pairs.order.size(); ++k) {
    const std::uint32_t i = side_pairs.order[k], own = side.own_of(pairs[i]);
    if (k == 0 || side.own_of(pairs[side_pairs.order[k - 1]]) != own) {
      side_pairs.first.push_back(k);
      const Triangle& t = part.triangles[own];
      side_pairs.edges.push_back({edge_between(part, t[0], t[1]), edge_between(part, t[1], t[2]),
                                  edge_between(part, t[2], t[0])});
    }
    side_pairs.row[i] = static_cast<std::uint32_t>(side_pairs.first.size() - 1);
  }
  side_pairs.first.push_back(static_cast<std::uint32_t>(pairs.size()));
  return side_pairs;
}

std::size_t join_around_triangles(const RegionSide& side, const PairsByTriangle& own,
                                  const PairsByTriangle& other,
                                  std::span<const NearTrianglePair> pairs, double reach,
                                  UnionFind& sets) {
  const double squared = reach * reach;
  std::size_t joins = 0;
  std::vector<SharedFeature> features;
  for (std::size_t r = 0; r + 1 < own.first.size(); ++r) {
    const auto group = own.group(r);
    const auto together = [&] {
      return std::ranges::all_of(group, [&](std::uint32_t i) { return sets.joined(group[0], i); });
    };
    if (together()) continue;
    const Corners t = as_doubles(side.own.corners(side.own_of(pairs[group[0]])));
    features.clear();
    for (const std::uint32_t i : group)
      for (const std::uint32_t edge : other.edges[other.row[i]])
        if (edge != kNoIndex) features.push_back({edge, i});
    joins += join_features(features, sets, [&](std::uint32_t edge) {
      return near_along_edge(side.other, edge, t, squared).has_value();
    });
    // Triangles round a vertex are connected over edges, except where two fans only touch.
    if (together()) continue;
    features.clear();
    for (const std::uint32_t i : group)
      for (const std::uint32_t v : side.other.part().triangles[side.other_of(pairs[i])])
        features.push_back({v, i});
    joins += join_features(features, sets, [&](std::uint32_t vertex) {
      const Vec3d p = side.other.vertex(vertex).as<double>(), d = p - nearest_on_triangle(p, t);
      return dot(d, d) <= squared;
    });
  }
  return joins;
}

std::vector<EdgeHit> edge_hits(const RegionSide& side, const PairsByTriangle& own,
                               std::span<const NearTrianglePair> pairs, double reach) {
  std::vector<EdgeHit> stops;
  stops.reserve(3 * pairs.size());
  for (std::uint32_t i = 0; i < pairs.size(); ++i)
    for (const std::uint32_t edge : own.edges[own.row[i]])
      if (edge != kNoIndex) stops.push_back({edge, side.other_of(pairs[i]), i, 0});
  std::ranges::sort(stops, [](const EdgeHit& x, const EdgeHit& y) {
    return std::tie(x.edge, x.other, x.pair) < std::tie(y.edge, y.other, y.pair);
  });
  std::size_t kept = 0;
  for (std::size_t first = 0; first < stops.size();) {
    std::size_t last = first;
    while (last < stops.size() && stops[last].edge == stops[first].edge &&
           stops[last].other == stops[first].other)
      ++last;
    const std::optional<double> along =
        near_along_edge(side.own, stops[first].edge,
                        as_doubles(side.other.corners(stops[first].other)), reach * reach);
    if (along)
      for (std::size_t i = first; i < last; ++i) {
        stops[kept] = stops[i];
        stops[kept++].along = *along;
      }
    first = last;
  }
  stops.resize(kept);
  return stops;
}

}  // namespace strake::geometry
