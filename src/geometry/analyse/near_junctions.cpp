// SPDX-License-Identifier: Apache-2.0
#include "geometry/analyse/near_junctions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <tuple>
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

bool by_ends(const OpenEdge& x, const OpenEdge& y) {
  return std::tie(x.low, x.high) < std::tie(y.low, y.high);
}

/// The pieces of edges, each once, with all triangles that would run along it and back.
class Pieces {
 public:
  explicit Pieces(const std::vector<Beside>& edges) {
    for (const Beside& b : edges) {
      std::uint32_t from = b.edge.low;
      for (const std::uint32_t p : b.corners) {
        add(from, p, b.edge);
        from = p;
      }
      add(from, b.edge.high, b.edge);
    }
    std::sort(all_.begin(), all_.end(), by_ends);
    std::size_t kept = 0;
    for (const OpenEdge& piece : all_) {
      if (kept > 0 && all_[kept - 1].low == piece.low && all_[kept - 1].high == piece.high) {
        all_[kept - 1].along += piece.along;
        all_[kept - 1].back += piece.back;
      } else {
        all_[kept++] = piece;
      }
    }
    all_.resize(kept);
  }

  /// Whether triangles run along a piece and back.
  [[nodiscard]] bool matches(std::uint32_t p, std::uint32_t q) const {
    const OpenEdge key{std::min(p, q), std::max(p, q), 0, 0};
    const auto at = std::lower_bound(all_.begin(), all_.end(), key, by_ends);
    return at->along > 0 && at->back > 0;
  }

 private:
  void add(std::uint32_t from, std::uint32_t to, const OpenEdge& whole) {
    OpenEdge piece{from, to, whole.along, whole.back};
    if (from > to) {
      std::swap(piece.low, piece.high);
      std::swap(piece.along, piece.back);
    }
    all_.push_back(piece);
  }

  std::vector<OpenEdge> all_;
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
  const std::vector<Vec3i>& at = welded.vertices;
  for (Beside& b : edges) {
    keep_matching(b, pieces);
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
