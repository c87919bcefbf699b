// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_repair/tolerance_weld.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "geometry/mesh_repair/make_part.hpp"
#include "geometry/mesh_repair/near_vertices.hpp"
#include "geometry/mesh_repair/t_junctions.hpp"
#include "geometry/mesh_repair/weld.hpp"

namespace strake::geometry {
namespace {

/// An edge with the vertices beside it, in order along it.
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

/// Finds the vertices beside an edge: none of its own triangles, and near neither end.
class NearCornerFinder {
 public:
  NearCornerFinder(const GridMesh& welded, const Topology& topology, const NearPoints& points,
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
  constexpr int kMaxPasses = 16;
  Pieces pieces(edges);
  bool dropped = true;
  for (int pass = 0; pass < kMaxPasses && dropped; ++pass) {
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

NearTJunctions find_near_t_junctions(const GridMesh& welded, const Topology& topology,
                                     const NearPoints& points,
                                     const std::vector<std::uint8_t>& may_cut,
                                     std::int64_t within) {
  constexpr std::size_t kMaxCuts = 8, kAlwaysCuts = 64;
  NearTJunctions found;
  std::vector<Beside> edges;
  std::size_t corners = 0;
  NearCornerFinder finder(welded, topology, points, may_cut, within);
  for (const std::uint32_t e : topology.uneven) {
    Beside beside = finder.beside(e);
    if (beside.edge.balances()) continue;
    corners += beside.corners.size();
    edges.push_back(std::move(beside));
    found.tangled = finder.tangled() || corners > kMaxCuts * topology.uneven.size() + kAlwaysCuts;
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

namespace {

enum class Nearness : std::uint8_t {
  none,
  some,     ///< a corner of one open edge is near another
  tangled,  ///< that takes too long to tell, as all edges run past all corners
};

Nearness nearness(std::span<const Vec3i> vertices, std::span<const OpenEdge> open,
                  const NearPoints& points, std::int64_t within) {
  std::vector<std::uint32_t> near;
  std::uint64_t boxes = NearPoints::boxes_for(open.size());
  for (const OpenEdge& e : open) {
    near.clear();
    if (!points.near(vertices[e.low], vertices[e.high], within, boxes, near))
      return Nearness::tangled;
    if (near.size() > 2) return Nearness::some;  // more than its own ends
  }
  return Nearness::none;
}

/// One attempt after another, until what is left closes seams and makes nothing thin.
class Welder {
 public:
  Welder(std::vector<OpenEdge> open, std::int64_t within, Closing closing, RepairScratch& scratch)
      : within_(within),
        closing_(closing),
        scratch_(scratch),
        whole_(scratch.welded),
        open_(std::move(open)),
        corners_(ends_of(open_)),
        points_(whole_.vertices, corners_) {
    may_move_.assign(whole_.vertices.size(), 0);
    for (const std::uint32_t v : corners_) may_move_[v] = 1;
  }

  /// Whether any vertices are near; call it first.
  [[nodiscard]] bool any_near() {
    const Nearness found = nearness(whole_.vertices, open_, points_, within_);
    junctions_.tangled = found == Nearness::tangled;
    return found != Nearness::none;
  }

  std::optional<ToleranceWeld> weld(Topology& topology) {
    constexpr int kMaxAttempts = 4;  // two are usual (decision 0034)
    find_clusters();
    bool settled = false;
    for (int i = 0; i < kMaxAttempts && !settled; ++i) {
      attempt(topology);
      settled = all_of_use(topology);
    }
    if (!settled || result_.corners == 0) {
      scratch_.welded = std::move(whole_);
      topology = topology_now();
      return std::nullopt;
    }
    return result_;
  }

 private:
  Topology topology_now() {
    return make_topology(scratch_.welded.vertices.size(), scratch_.welded.triangles,
                         scratch_.topology);
  }

  void attempt(Topology& topology) {
    result_ = {};
    move_corners();
    result_.repeated = replace_triangles(whole_, at_, scratch_);
    topology = topology_now();
    std::vector<std::uint8_t> may_cut = may_move_;
    for (const std::uint32_t v : corners_)
      if (at_[v] != v) may_cut[v] = 0;
    const bool tangled = junctions_.tangled;
    junctions_ = {};
    junctions_.tangled = tangled;
    if (!tangled)
      junctions_ = find_near_t_junctions(scratch_.welded, topology, points_, may_cut, within_);
    if (!junctions_.cuts.none()) {
      const CutMesh cut = cut_edges(scratch_.welded, junctions_.cuts);
      std::vector<std::uint32_t> same(at_.size());
      std::iota(same.begin(), same.end(), 0U);
      result_.repeated = replace_triangles({{}, cut.triangles, cut.faces}, same, scratch_);
      topology = topology_now();
    }
    result_.corners += junctions_.corners.size();
    result_.largest = std::max(result_.largest, junctions_.largest);
  }

  /// Finds clusters of the vertices that may move; those found to close nothing stay apart.
  void find_clusters() {
    std::vector<std::uint32_t> some;
    for (const std::uint32_t v : corners_)
      if (may_move_[v] != 0) some.push_back(v);
    clusters_ =
        cluster_near_vertices(whole_.vertices, some, NearPoints(whole_.vertices, some), within_);
    std::erase_if(clusters_, [&](const VertexCluster& c) {
      return std::binary_search(useless_.begin(), useless_.end(), c.members.front());
    });
  }

  void move_corners() {
    at_.resize(whole_.vertices.size());
    std::iota(at_.begin(), at_.end(), 0U);
    for (const VertexCluster& c : clusters_)
      for (const std::uint32_t v : c.members) {
        at_[v] = c.at;
        result_.corners += v != c.at ? 1U : 0U;
        const auto squared = squared_distance(whole_.vertices[v], whole_.vertices[c.at]);
        result_.largest = std::max(result_.largest, std::sqrt(static_cast<double>(squared)));
      }
  }

  /// Whether all that was moved closes seams, and none of it a thin shell; else the next attempt
  /// leaves the others alone.
  bool all_of_use(const Topology& topology) {
    const std::vector<std::uint32_t> joined = joined_edges(topology);
    std::vector<std::uint8_t> joins(at_.size(), 0);
    for (const std::uint32_t e : joined)
      joins[topology.edges[e].v0] = joins[topology.edges[e].v1] = 1;
    const auto is_useless = [&](const VertexCluster& c) { return joins[c.at] == 0; };
    const std::size_t before = useless_.size();
    for (const VertexCluster& c : clusters_)
      if (is_useless(c)) useless_.push_back(c.members.front());
    std::sort(useless_.begin(), useless_.end());
    const bool left = leave_shells(topology, joined);
    if (left)
      find_clusters();
    else
      std::erase_if(clusters_, is_useless);
    return useless_.size() == before && !left;
  }

  /// The edges, of the mesh as it is now, at which more triangles meet than at the open edges that
  /// they were.
  std::vector<std::uint32_t> joined_edges(const Topology& topology) const {
    const auto all = topology.edges.first(topology.edges.size() - 1);
    std::vector<std::uint32_t> joined;
    const auto add_if_joined = [&](std::uint32_t p, std::uint32_t q, std::size_t triangles) {
      const auto key = std::minmax(p, q);
      const auto e =
          std::lower_bound(all.begin(), all.end(), key, [](const PartEdge& x, const auto& k) {
            return std::pair(x.v0, x.v1) < std::pair<std::uint32_t, std::uint32_t>(k);
          });
      if (e == all.end() || e->v0 != key.first || e->v1 != key.second) return;
      const auto number = static_cast<std::uint32_t>(e - all.begin());
      if (topology.triangles_of(number).size() > triangles) joined.push_back(number);
    };
    for (const OpenEdge& e : open_) {
      const auto [low, high] = std::minmax(at_[e.low], at_[e.high]);
      if (low == high) continue;
      std::uint32_t from = low;
      for (const std::uint32_t p : junctions_.cuts.points_on(low, high)) {
        add_if_joined(from, p, e.along + e.back);
        from = p;
      }
      add_if_joined(from, high, e.along + e.back);
    }
    std::sort(joined.begin(), joined.end());
    joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
    return joined;
  }

  /// Counts the shells that are closed at these edges. The corners of those that are no thicker
  /// than corners may lie apart are to stay and, where whole shells are requested, those of all
  /// others; whether there are any.
  bool leave_shells(const Topology& topology, const std::vector<std::uint32_t>& joined) {
    const GridMesh& mesh = scratch_.welded;
    if (joined.empty()) return false;
    const ShellLabels labels =
        label_shells(mesh.vertices, mesh.triangles, topology, scratch_.topology);
    std::vector<std::uint8_t> is_new(labels.count, 0);
    const auto shell_of = [&](std::uint32_t t) {
      return labels.shell.empty() ? 0 : labels.shell[t];
    };
    for (const std::uint32_t e : joined)
      for (const std::uint32_t t : topology.triangles_of(e)) is_new[shell_of(t)] = 1;
    std::vector<std::vector<Triangle>> shells(labels.count);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::uint32_t s = shell_of(t);
      if (is_new[s] != 0 && labels.closed[s] != 0) shells[s].push_back(mesh.triangles[t]);
    }
    std::vector<std::uint8_t> thin(at_.size(), 0), whole(at_.size(), 0);
    bool any = false;
    for (const std::vector<Triangle>& shell : shells) {
      if (shell.empty()) continue;
      const auto volume_6 = static_cast<double>(signed_volume_6(mesh.vertices, shell));
      // Twice the volume by the area is the thickness.
      if (std::fabs(volume_6) / 3 > static_cast<double>(within_) * area_of(mesh.vertices, shell)) {
        ++result_.shells;
        mark(shell, whole);
        continue;
      }
      mark(shell, thin);
      any = true;
    }
    for (const std::uint32_t v : corners_) {
      const bool stays =
          thin[at_[v]] != 0 || (closing_ == Closing::whole_shells && whole[at_[v]] == 0);
      if (!stays || may_move_[v] == 0) continue;
      may_move_[v] = 0;
      any = true;
    }
    return any;
  }

  static void mark(const std::vector<Triangle>& shell, std::vector<std::uint8_t>& vertices) {
    for (const Triangle& t : shell)
      for (const std::uint32_t v : t) vertices[v] = 1;
  }

  std::int64_t within_;
  Closing closing_;
  RepairScratch& scratch_;
  GridMesh whole_;  ///< as it came
  std::vector<OpenEdge> open_;
  std::vector<std::uint32_t> corners_;  ///< their ends
  NearPoints points_;
  std::vector<std::uint8_t> may_move_;  ///< per vertex
  std::vector<std::uint32_t> useless_;  ///< the first of clusters that close nothing
  std::vector<std::uint32_t> at_;       ///< per vertex: the one that it counts as
  std::vector<VertexCluster> clusters_;
  NearTJunctions junctions_;
  ToleranceWeld result_;
};

}  // namespace

bool may_weld_within_tolerance(std::span<const Vec3i> vertices, std::span<const Triangle> triangles,
                               const Topology& topology, std::int64_t within) {
  const std::vector<OpenEdge> open = open_edges(triangles, topology);
  return !open.empty() &&
         nearness(vertices, open, NearPoints(vertices, ends_of(open)), within) != Nearness::none;
}

std::optional<ToleranceWeld> weld_within_tolerance(std::int64_t within, Closing closing,
                                                   Topology& topology, RepairScratch& scratch) {
  std::vector<OpenEdge> open = open_edges(scratch.welded.triangles, topology);
  if (open.empty()) return std::nullopt;
  Welder welder(std::move(open), within, closing, scratch);
  return welder.any_near() ? welder.weld(topology) : std::nullopt;
}

}  // namespace strake::geometry
