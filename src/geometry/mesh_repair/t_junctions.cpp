// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_repair/t_junctions.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

#include "strake/core/hash.hpp"

namespace strake::geometry {
namespace {

/// A line by its primitive direction, the first coordinate that is not 0 positive, and its moment.
/// 63 bits hold it: coordinates are within 2^30.
struct Line {
  Vec3l way, moment;

  friend auto operator<=>(const Line&, const Line&) = default;
};

Line line_of(const Vec3i& low, const Vec3i& high) {
  const Vec3l from = low.as<std::int64_t>();
  Vec3l way = high.as<std::int64_t>() - from;
  // The higher vertex is the greater one by (x, y, z), so the sign is as it should be.
  const std::int64_t steps = std::gcd(std::gcd(way.x, way.y), way.z);
  way = {way.x / steps, way.y / steps, way.z / steps};
  return {way, cross(from, way)};
}

std::uint64_t hash_of(const Line& line) {
  const std::array<std::int64_t, 6> words{line.way.x,    line.way.y,    line.way.z,
                                          line.moment.x, line.moment.y, line.moment.z};
  return hash_bytes(std::as_bytes(std::span(words))).low;
}

/// Calls take() for each run of equal neighbours.
template <class T, class Same, class Take>
void each_run(std::span<const T> all, const Same& same, const Take& take) {
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    for (end = first + 1; end < all.size() && same(all[first], all[end]);) ++end;
    take(all.subspan(first, end - first));
  }
}

}  // namespace

TJunctions::TJunctions(std::span<const Vec3i> vertices, std::span<const Triangle> triangles,
                       const Topology& topology) {
  // Of very many edges that do not balance few lie on one line: a hash filters the others first.
  struct Hashed {
    std::uint64_t hash = 0;
    OpenEdge edge;
  };
  std::vector<Hashed> open;
  for (const auto& edges : {topology.uneven, topology.folded})
    for (const std::uint32_t e : edges) {
      const OpenEdge edge = count_triangles(triangles, topology, e);
      if (!edge.balances() || edge.along == 1)
        open.push_back({hash_of(line_of(vertices[edge.low], vertices[edge.high])), edge});
    }
  std::sort(open.begin(), open.end(), [](const Hashed& x, const Hashed& y) {
    return std::tie(x.hash, x.edge.low, x.edge.high) < std::tie(y.hash, y.edge.low, y.edge.high);
  });
  std::vector<std::pair<Line, OpenEdge>> alike;
  std::vector<OpenEdge> on_line;
  const auto same_hash = [](const Hashed& x, const Hashed& y) { return x.hash == y.hash; };
  each_run<Hashed>(open, same_hash, [&](std::span<const Hashed> run) {
    constexpr std::size_t kFewest = 3;  // a whole edge and two pieces of it
    if (run.size() < kFewest) return;
    alike.clear();
    for (const Hashed& h : run)
      alike.emplace_back(line_of(vertices[h.edge.low], vertices[h.edge.high]), h.edge);
    const auto by_line = [](const auto& x, const auto& y) { return x.first < y.first; };
    std::sort(alike.begin(), alike.end(), by_line);
    const auto same_line = [](const auto& x, const auto& y) { return x.first == y.first; };
    each_run<std::pair<Line, OpenEdge>>(alike, same_line, [&](const auto& line) {
      on_line.clear();
      for (const auto& [key, edge] : line) on_line.push_back(edge);
      split_edges_on_line(on_line);
    });
  });
  cuts_.settle(vertices.size());
}

void TJunctions::split_edges_on_line(std::span<const OpenEdge> edges) {
  std::vector<std::uint32_t>& ends = line_points_;
  ends.clear();
  for (const OpenEdge& e : edges) ends.insert(ends.end(), {e.low, e.high});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  // How many triangles run along each interval between two ends, and how many back.
  along_.assign(ends.size(), 0);
  back_.assign(ends.size(), 0);
  const auto place = [&](std::uint32_t v) {
    return static_cast<std::size_t>(std::lower_bound(ends.begin(), ends.end(), v) - ends.begin());
  };
  for (const OpenEdge& e : edges) {
    const std::size_t low = place(e.low), high = place(e.high);
    along_[low] += e.along, along_[high] -= e.along;
    back_[low] += e.back, back_[high] -= e.back;
  }
  std::partial_sum(along_.begin(), along_.end(), along_.begin());
  std::partial_sum(back_.begin(), back_.end(), back_.begin());
  const auto matches = [&](std::size_t i) { return along_[i] > 0 && back_[i] > 0; };
  const std::size_t first_point = cuts_.points(), first_edge = cuts_.edges();
  for (std::size_t i = 1; i + 1 < ends.size(); ++i)
    if (matches(i - 1) || matches(i)) cuts_.add_point(ends[i]);
  // Surfaces match in pairs: each is split at no more points than the others have, unless they run
  // to and fro.
  constexpr std::size_t kMaxCuts = 8;
  const std::size_t largest = kMaxCuts * edges.size() + 64;
  std::size_t cuts = 0;
  for (const OpenEdge& e : edges) {
    const std::span<const std::uint32_t> points = cuts_.points_from(first_point);
    const auto from = std::upper_bound(points.begin(), points.end(), e.low);
    const auto to = std::lower_bound(from, points.end(), e.high);
    if (from == to) continue;
    const auto count = static_cast<std::size_t>(to - from);
    const auto before = static_cast<std::size_t>(from - points.begin());
    cuts_.add(e.low, e.high, first_point + before, count);
    cuts += count * (e.along + e.back);
  }
  if (cuts > largest || cuts_.edges() == first_edge) cuts_.drop(first_point, first_edge);
}

std::size_t EdgeCuts::add_point(std::uint32_t vertex) {
  points_.push_back(vertex);
  return points_.size() - 1;
}

void EdgeCuts::add(std::uint32_t low, std::uint32_t high, std::size_t first, std::size_t count) {
  edges_.push_back({low, high, first, count});
}

void EdgeCuts::drop(std::size_t points, std::size_t edges) {
  points_.resize(points);
  edges_.resize(edges);
}

void EdgeCuts::settle(std::size_t vertices) {
  std::sort(edges_.begin(), edges_.end(), [](const Edge& x, const Edge& y) {
    return std::tie(x.low, x.high) < std::tie(y.low, y.high);
  });
  if (!edges_.empty()) on_edge_.resize(vertices, 0);
  for (const Edge& e : edges_) on_edge_[e.low] = on_edge_[e.high] = 1;
}

std::span<const std::uint32_t> EdgeCuts::points_on(std::uint32_t low, std::uint32_t high) const {
  if (none() || on_edge_[low] == 0 || on_edge_[high] == 0) return {};
  const auto at = std::lower_bound(
      edges_.begin(), edges_.end(), std::pair(low, high),
      [](const Edge& e, const auto& key) { return std::pair(e.low, e.high) < key; });
  if (at == edges_.end() || at->low != low || at->high != high) return {};
  return std::span(points_).subspan(at->first, at->count);
}

namespace {

/// Cuts triangles along the sides that are to be cut.
class TriangleSplitter {
 public:
  TriangleSplitter(const EdgeCuts& cuts, std::vector<Triangle>& pieces)
      : cuts_(cuts), pieces_(pieces) {}

  void cut(const Triangle& t) {
    const std::optional<std::size_t> first = first_side(t);
    if (!first) {
      pieces_.push_back(t);
      return;
    }
    const std::uint32_t from = t[*first], to = t[(*first + 1) % 3], top = t[(*first + 2) % 3];
    const auto points = points_between(from, to);
    // The outer two pieces have the other sides, which may have to be cut as well.
    fan(top, from, points.front());
    for (std::size_t i = 1; i < points.size(); ++i)
      pieces_.push_back({points[i - 1], points[i], top});
    fan(to, top, points.back());
  }

 private:
  /// The lowest of those that are to be cut.
  [[nodiscard]] std::optional<std::size_t> first_side(const Triangle& t) const {
    std::optional<std::size_t> first;
    const auto key = [&](std::size_t k) { return std::minmax(t[k], t[(k + 1) % 3]); };
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = key(k);
      if (!cuts_.points_on(low, high).empty() && (!first || key(k) < key(*first))) first = k;
    }
    return first;
  }

  [[nodiscard]] std::vector<std::uint32_t> points_between(std::uint32_t from,
                                                          std::uint32_t to) const {
    const auto points = cuts_.points_on(std::min(from, to), std::max(from, to));
    std::vector<std::uint32_t> way(points.begin(), points.end());
    if (from > to) std::ranges::reverse(way);
    return way;
  }

  /// A triangle of which only the side from-to may have to be cut.
  void fan(std::uint32_t from, std::uint32_t to, std::uint32_t top) {
    std::uint32_t last = from;
    for (const std::uint32_t p : points_between(from, to)) {
      pieces_.push_back({last, p, top});
      last = p;
    }
    pieces_.push_back({last, to, top});
  }

  const EdgeCuts& cuts_;
  std::vector<Triangle>& pieces_;
};

}  // namespace

CutMesh cut_edges(const GridMesh& welded, const EdgeCuts& cuts) {
  CutMesh mesh;
  TriangleSplitter cutter(cuts, mesh.triangles);
  for (std::size_t i = 0; i < welded.triangles.size(); ++i) {
    const std::size_t before = mesh.triangles.size();
    cutter.cut(welded.triangles[i]);
    mesh.cut += mesh.triangles.size() - before > 1 ? 1U : 0U;
    if (!welded.faces.empty()) mesh.faces.resize(mesh.triangles.size(), welded.faces[i]);
  }
  return mesh;
}

std::optional<CutMesh> split_at_t_junctions(const GridMesh& welded, const Topology& topology) {
  const TJunctions junctions(welded.vertices, welded.triangles, topology);
  if (junctions.none()) return std::nullopt;
  return cut_edges(welded, junctions.cuts());
}

}  // namespace strake::geometry
