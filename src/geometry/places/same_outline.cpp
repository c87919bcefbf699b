// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/places/flat_end.hpp"
#include "geometry/segment_pair.hpp"

// Of two faces whose rims run along each other, each point of the one has its like in the other
// within reach. Whatever else is near hangs together with that: up the walls to the rims, and from
// a point of one rim to a point of the other through the face between them. Only across a gap in
// the face, a notch or a hole narrower than the reach, there is no such way, so that there must be
// none.

namespace strake::geometry {
namespace {

using RimEdge = FlatEnd::RimEdge;

/// Of rims with more pairs of edges near each other, for each edge, nothing is said.
constexpr std::size_t kMostNear = 16;

struct RimCorner {
  Flat at;
  std::uint32_t vertex = 0;
};

std::vector<RimCorner> corners_of(std::span<const RimEdge> rim) {
  std::vector<RimCorner> corners;
  for (const RimEdge& e : rim) {
    corners.push_back({e.at_from, e.from});
    corners.push_back({e.at_to, e.to});
  }
  std::ranges::sort(corners, [](const RimCorner& p, const RimCorner& q) {
    return std::tie(p.at.x, p.at.y, p.vertex) < std::tie(q.at.x, q.at.y, q.vertex);
  });
  const auto rest = std::ranges::unique(corners, {}, &RimCorner::vertex);
  corners.erase(rest.begin(), rest.end());
  return corners;
}

/// By vertex of the first part: the vertex of the second that stands there, the only one.
using Likes = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

std::optional<Likes> likes_of(std::span<const RimCorner> a, std::span<const RimCorner> b,
                              double room) {
  if (a.size() != b.size()) return std::nullopt;
  Likes likes;
  std::vector<std::uint32_t> taken;
  for (const RimCorner& p : a) {
    const auto first =
        std::ranges::lower_bound(b, p.at.x - room, {}, [](const RimCorner& q) { return q.at.x; });
    std::optional<std::uint32_t> like;
    for (auto q = first; q != b.end() && q->at.x <= p.at.x + room; ++q) {
      if (std::hypot(q->at.x - p.at.x, q->at.y - p.at.y) > room) continue;
      if (like) return std::nullopt;
      like = q->vertex;
    }
    if (!like) return std::nullopt;
    likes.emplace_back(p.vertex, *like);
    taken.push_back(*like);
  }
  std::ranges::sort(taken);
  if (std::ranges::adjacent_find(taken) != taken.end()) return std::nullopt;
  std::ranges::sort(likes);
  return likes;
}

/// Whether each edge of the one rim has its like in the other.
bool run_along_each_other(std::span<const RimEdge> a, std::span<const RimEdge> b, double room) {
  const auto likes = likes_of(corners_of(a), corners_of(b), room);
  if (!likes) return false;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const RimEdge& e : b) edges.emplace_back(e.from, e.to);
  std::ranges::sort(edges);
  const auto like = [&](std::uint32_t v) {
    return std::ranges::lower_bound(*likes, v, {}, &Likes::value_type::first)->second;
  };
  return std::ranges::all_of(a, [&](const RimEdge& e) {
    const std::uint32_t from = like(e.from), to = like(e.to);
    return std::ranges::binary_search(edges, std::pair(std::min(from, to), std::max(from, to)));
  });
}

/// Whether two edges of a rim that have no corner in common are near each other, and what lies
/// between them there is not their face.
struct RimGap {
  bool near = false, open = false;
};

RimGap gap_between(const RimEdge& e, const RimEdge& f, double reach) {
  const auto raised = [](const Flat& p) { return Vec3d{p.x, p.y, 0}; };
  const Vec3d p = raised(e.at_from), d = raised(e.at_to) - p;
  const Vec3d q = raised(f.at_from), g = raised(f.at_to) - q;
  const auto [s, t] = nearest_on_segments(p, d, q, g);
  const Vec3d way = (q + g * t) - (p + d * s);
  if (!(dot(way, way) <= reach * reach)) return {};
  return {true, !(dot(way, raised(e.inward)) > 0 && dot(way, raised(f.inward)) < 0)};
}

/// Whether a gap in the face is narrower than the reach. Found by a sweep along x.
bool has_narrow_gap(std::vector<RimEdge> rim, double reach) {
  const auto low = [](const RimEdge& e) { return std::min(e.at_from.x, e.at_to.x); };
  const auto high = [](const RimEdge& e) { return std::max(e.at_from.x, e.at_to.x); };
  std::ranges::sort(rim, {}, low);
  const auto apart_in_y = [&](const RimEdge& e, const RimEdge& f) {
    const auto [e0, e1] = std::minmax(e.at_from.y, e.at_to.y);
    const auto [f0, f1] = std::minmax(f.at_from.y, f.at_to.y);
    return std::max(e0 - f1, f0 - e1) > reach;
  };
  const auto share_corner = [](const RimEdge& e, const RimEdge& f) {
    return e.from == f.from || e.from == f.to || e.to == f.from || e.to == f.to;
  };
  std::size_t left = kMostNear * rim.size();
  for (std::size_t i = 0; i < rim.size(); ++i)
    for (std::size_t j = i + 1; j < rim.size() && low(rim[j]) <= high(rim[i]) + reach; ++j) {
      if (apart_in_y(rim[i], rim[j]) || share_corner(rim[i], rim[j])) continue;
      const RimGap gap = gap_between(rim[i], rim[j], reach);
      if (gap.open || (gap.near && left-- == 0)) return true;
    }
  return false;
}

}  // namespace

bool same_outline(const FlatEnd& a, const FlatEnd& b, const FlatPlane& plane, double gap) {
  // Points of the two faces may be farther apart than their planes.
  const double across = std::fabs(gap) + 2 * plane.band;
  if (!(across < plane.reach)) return false;
  const double room = std::min(plane.band, std::sqrt(plane.reach * plane.reach - across * across));
  const std::vector<RimEdge> rim_a = a.rim(), rim_b = b.rim();
  return rim_a.size() == rim_b.size() && run_along_each_other(rim_a, rim_b, room) &&
         a.is_one_face() && b.is_one_face() && !has_narrow_gap(rim_a, plane.reach + 2 * room);
}

}  // namespace strake::geometry
