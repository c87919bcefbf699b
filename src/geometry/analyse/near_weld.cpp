// SPDX-License-Identifier: Apache-2.0
#include "geometry/analyse/near_weld.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "geometry/analyse/near_corners.hpp"
#include "geometry/analyse/near_junctions.hpp"
#include "geometry/analyse/open_edges.hpp"
#include "geometry/analyse/shell_part.hpp"
#include "geometry/analyse/weld.hpp"

namespace strake::geometry {
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
  Welder(std::vector<OpenEdge> open, std::int64_t within, Closing closing, AnalyseScratch& scratch)
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

  /// To be asked first.
  [[nodiscard]] bool any_near() {
    const Nearness found = nearness(whole_.vertices, open_, points_, within_);
    junctions_.tangled = found == Nearness::tangled;
    return found != Nearness::none;
  }

  std::optional<NearWeld> weld(Topology& topology) {
    constexpr int kMostAttempts = 4;
    find_clusters();
    bool settled = false;
    for (int i = 0; i < kMostAttempts && !settled; ++i) {
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
    if (!tangled) junctions_ = near_junctions(scratch_.welded, topology, points_, may_cut, within_);
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

  /// Of the corners that may move; those that were found to close nothing stay apart.
  void find_clusters() {
    std::vector<std::uint32_t> some;
    for (const std::uint32_t v : corners_)
      if (may_move_[v] != 0) some.push_back(v);
    clusters_ = near_corners(whole_.vertices, some, NearPoints(whole_.vertices, some), within_);
    std::erase_if(clusters_, [&](const CornerCluster& c) {
      return std::binary_search(useless_.begin(), useless_.end(), c.members.front());
    });
  }

  void move_corners() {
    at_.resize(whole_.vertices.size());
    std::iota(at_.begin(), at_.end(), 0U);
    for (const CornerCluster& c : clusters_)
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
    const auto is_useless = [&](const CornerCluster& c) { return joins[c.at] == 0; };
    const std::size_t before = useless_.size();
    for (const CornerCluster& c : clusters_)
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
    const auto look_at = [&](std::uint32_t p, std::uint32_t q, std::size_t triangles) {
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
        look_at(from, p, e.along + e.back);
        from = p;
      }
      look_at(from, high, e.along + e.back);
    }
    std::sort(joined.begin(), joined.end());
    joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
    return joined;
  }

  /// Counts the shells that are closed at these edges. The corners of those that are no thicker
  /// than corners may lie apart are to stay, and where whole shells are asked for those of all
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
  AnalyseScratch& scratch_;
  GridMesh whole_;  ///< as it came
  std::vector<OpenEdge> open_;
  std::vector<std::uint32_t> corners_;  ///< their ends
  NearPoints points_;
  std::vector<std::uint8_t> may_move_;  ///< per vertex
  std::vector<std::uint32_t> useless_;  ///< the first of clusters that close nothing
  std::vector<std::uint32_t> at_;       ///< per vertex: the one that it counts as
  std::vector<CornerCluster> clusters_;
  NearJunctions junctions_;
  NearWeld result_;
};

}  // namespace

bool may_weld_near(std::span<const Vec3i> vertices, std::span<const Triangle> triangles,
                   const Topology& topology, std::int64_t within) {
  const std::vector<OpenEdge> open = open_edges(triangles, topology);
  return !open.empty() &&
         nearness(vertices, open, NearPoints(vertices, ends_of(open)), within) != Nearness::none;
}

std::optional<NearWeld> weld_near(std::int64_t within, Closing closing, Topology& topology,
                                  AnalyseScratch& scratch) {
  std::vector<OpenEdge> open = open_edges(scratch.welded.triangles, topology);
  if (open.empty()) return std::nullopt;
  Welder welder(std::move(open), within, closing, scratch);
  return welder.any_near() ? welder.weld(topology) : std::nullopt;
}

}  // namespace strake::geometry
