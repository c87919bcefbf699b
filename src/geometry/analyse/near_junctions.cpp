// SPDX-License-Identifier: Apache-2.0
#include "geometry/analyse/near_junctions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <span>
#include <utility>

#include "geometry/analyse/open_edges.hpp"

namespace strake::geometry {
namespace {

/// An edge with the corners beside it, in order along it.
struct Beside {
  OpenEdge edge;
  std::vector<std::uint32_t> corners;
};

__int128 along(const Vec3i& from, const Vec3i& to, const Vec3i& p) {
  const Vec3l way = to.as<std::int64_t>() - from.as<std::int64_t>();
  const Vec3l at = p.as<std::int64_t>() - from.as<std::int64_t>();
  return __int128{way.x} * at.x + __int128{way.y} * at.y + __int128{way.z} * at.z;
}

double distance_to_line(const Vec3i& from, const Vec3i& to, const Vec3i& p) {
  const Vec3d way = (to.as<std::int64_t>() - from.as<std::int64_t>()).as<double>();
  const Vec3d off = cross((p.as<std::int64_t>() - from.as<std::int64_t>()).as<double>(), way);
  return std::sqrt(dot(off, off) / dot(way, way));
}

/// The pieces of edges, each once, with all triangles that run along it and back.
class Pieces {
 public:
  explicit Pieces(const std::vector<Beside>& edges) {
    for (const Beside& b : edges) {
      std::uint32_t from = b.edge.low;
      for (const std::uint32_t p : b.corners) {
        add(from, p, b.edge, 1);
        from = p;
      }
      add(from, b.edge.high, b.edge, 1);
    }
  }

  /// Whether triangles run along a piece and back.
  [[nodiscard]] bool matches(std::uint32_t p, std::uint32_t q) const {
    const auto [along, back] = of(p, q);
    return along > 0 && back > 0;
  }

  /// By how many triangles fewer the pieces fail to balance where an edge with the neighbours
  /// `from` and `to` of the corner p is not cut at p.
  [[nodiscard]] std::int64_t gain(const OpenEdge& edge, std::uint32_t from, std::uint32_t p,
                                  std::uint32_t to) const {
    const auto change = [&](std::uint32_t a, std::uint32_t b, std::int64_t times) {
      const auto [along, back] = of(a, b);
      const std::int64_t off = a < b ? along - back : back - along;
      const std::int64_t own = std::int64_t{edge.along} - std::int64_t{edge.back};
      return std::abs(off) - std::abs(off + times * own);
    };
    return change(from, p, -1) + change(p, to, -1) + change(from, to, 1);
  }

  void join(const OpenEdge& edge, std::uint32_t from, std::uint32_t p, std::uint32_t to) {
    add(from, p, edge, -1);
    add(p, to, edge, -1);
    add(from, to, edge, 1);
  }

 private:
  struct Counts {
    std::int64_t along = 0, back = 0;
  };

  [[nodiscard]] Counts of(std::uint32_t p, std::uint32_t q) const {
    const auto at = all_.find(std::minmax(p, q));
    return at == all_.end() ? Counts{} : at->second;
  }
  void add(std::uint32_t from, std::uint32_t to, const OpenEdge& whole, std::int64_t times) {
    Counts& counts = all_[std::minmax(from, to)];
    counts.along += times * (from < to ? whole.along : whole.back);
    counts.back += times * (from < to ? whole.back : whole.along);
  }

  std::map<std::pair<std::uint32_t, std::uint32_t>, Counts> all_;
};

/// The corners beside an edge: no corner of its own triangles, and near neither end.
class Finder {
 public:
  Finder(const GridMesh& welded, const Topology& topology, const NearPoints& points,
         const std::vector<std::uint8_t>& may_cut, std::int64_t within)
      : welded_(welded),
        topology_(topology),
        points_(points),
        may_cut_(may_cut),
        within_(within),
        boxes_(NearPoints::boxes_for(topology.uneven.size())) {}

  [[nodiscard]] Beside beside(std::uint32_t e) {
    Beside found{count_triangles(welded_.triangles, topology_, e), {}};
    const auto [low, high, forth, back] = found.edge;
    if (forth == back || may_cut_[low] == 0 || may_cut_[high] == 0) return found;
    const std::vector<Vec3i>& at = welded_.vertices;
    near_.clear();
    tangled_ = tangled_ || !points_.near(at[low], at[high], within_, boxes_, near_);
    for (const std::uint32_t v : near_)
      if (may_cut_[v] != 0 && !is_near(at[v], at[low]) && !is_near(at[v], at[high]) &&
          !is_corner(e, v))
        found.corners.push_back(v);
    std::sort(found.corners.begin(), found.corners.end(), [&](std::uint32_t p, std::uint32_t q) {
      const auto x = along(at[low], at[high], at[p]), y = along(at[low], at[high], at[q]);
      return x != y ? x < y : p < q;
    });
    return found;
  }

  /// Whether it has given up: all edges run past all corners.
  [[nodiscard]] bool tangled() const { return tangled_; }

 private:
  [[nodiscard]] bool is_near(const Vec3i& p, const Vec3i& q) const {
    return squared_distance(p, q) <= __int128{within_} * within_;
  }
  [[nodiscard]] bool is_corner(std::uint32_t e, std::uint32_t v) const {
    const auto around = topology_.triangles_of(e);
    return std::any_of(around.begin(), around.end(), [&](std::uint32_t t) {
      const Triangle& corners = welded_.triangles[t];
      return std::find(corners.begin(), corners.end(), v) != corners.end();
    });
  }

  const GridMesh& welded_;
  const Topology& topology_;
  const NearPoints& points_;
  const std::vector<std::uint8_t>& may_cut_;
  std::int64_t within_;
  std::uint64_t boxes_;
  bool tangled_ = false;
  std::vector<std::uint32_t> near_;
};

/// Keeps the corners that end a piece which matches.
void keep_matching(Beside& b, const Pieces& pieces) {
  std::vector<std::uint32_t> ends{b.edge.low};
  ends.insert(ends.end(), b.corners.begin(), b.corners.end());
  ends.push_back(b.edge.high);
  b.corners.clear();
  for (std::size_t i = 1; i + 1 < ends.size(); ++i)
    if (pieces.matches(ends[i - 1], ends[i]) || pieces.matches(ends[i], ends[i + 1]))
      b.corners.push_back(ends[i]);
}

/// Drops corners by which more pieces stay open than without them: a corner of one edge may lie
/// beside another as well, where the two meet at a small angle. One after another, in at most
/// 16 passes.
void drop_needless(std::vector<Beside>& edges) {
  constexpr int kMostPasses = 16;
  Pieces pieces(edges);
  bool dropped = true;
  for (int pass = 0; pass < kMostPasses && dropped; ++pass) {
    dropped = false;
    for (Beside& b : edges)
      for (std::size_t i = 0; i < b.corners.size();) {
        const std::uint32_t from = i == 0 ? b.edge.low : b.corners[i - 1],
                            to = i + 1 == b.corners.size() ? b.edge.high : b.corners[i + 1];
        if (pieces.gain(b.edge, from, b.corners[i], to) <= 0) {
          ++i;
          continue;
        }
        pieces.join(b.edge, from, b.corners[i], to);
        b.corners.erase(b.corners.begin() + static_cast<std::ptrdiff_t>(i));
        dropped = true;
      }
  }
}

}  // namespace

NearJunctions near_junctions(const GridMesh& welded, const Topology& topology,
                             const NearPoints& points, const std::vector<std::uint8_t>& may_cut,
                             std::int64_t within) {
  constexpr std::size_t kMostCuts = 8, kAlwaysCuts = 64;
  NearJunctions found;
  std::vector<Beside> edges;
  std::size_t corners = 0;
  Finder finder(welded, topology, points, may_cut, within);
  for (const std::uint32_t e : topology.uneven) {
    Beside beside = finder.beside(e);
    if (beside.edge.balances()) continue;
    corners += beside.corners.size();
    edges.push_back(std::move(beside));
    found.tangled = finder.tangled() || corners > kMostCuts * topology.uneven.size() + kAlwaysCuts;
    if (found.tangled) return found;
  }
  if (corners == 0) return found;
  const Pieces pieces(edges);
  for (Beside& b : edges) keep_matching(b, pieces);
  drop_needless(edges);
  const std::vector<Vec3i>& at = welded.vertices;
  for (const Beside& b : edges) {
    if (b.corners.empty()) continue;
    const std::size_t first = found.cuts.points();
    for (const std::uint32_t p : b.corners) {
      found.cuts.add_point(p);
      found.corners.push_back(p);
      found.largest =
          std::max(found.largest, distance_to_line(at[b.edge.low], at[b.edge.high], at[p]));
    }
    found.cuts.add(b.edge.low, b.edge.high, first, b.corners.size());
  }
  found.cuts.settle(at.size());
  std::sort(found.corners.begin(), found.corners.end());
  found.corners.erase(std::unique(found.corners.begin(), found.corners.end()), found.corners.end());
  return found;
}

}  // namespace strake::geometry
