// SPDX-License-Identifier: Apache-2.0
#include "geometry/analyse/topology.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace strake::geometry {
namespace {

struct HalfEdge {
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
};

/// Stable by higher vertex: entries arrive by triangle.
void sort_bucket(std::span<HalfEdge> bucket) {
  if (bucket.size() > 32) {
    std::stable_sort(bucket.begin(), bucket.end(),
                     [](const HalfEdge& a, const HalfEdge& b) { return a.high < b.high; });
    return;
  }
  for (std::size_t i = 1; i < bucket.size(); ++i) {
    const HalfEdge moved = bucket[i];
    std::size_t k = i;
    for (; k > 0 && bucket[k - 1].high > moved.high; --k) bucket[k] = bucket[k - 1];
    bucket[k] = moved;
  }
}

/// Disjoint sets whose representative is their lowest member.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  [[nodiscard]] std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

using Nets = std::vector<std::pair<std::uint32_t, int>>;  // set, its net sense on one edge

/// The sum of senses of each set round one edge, only those that are not zero.
void net_senses(std::span<const Triangle> triangles, const Topology& topology, std::size_t edge,
                Sets& sets, Nets& nets) {
  nets.clear();
  for (const std::uint32_t t : topology.triangles_of(edge))
    nets.emplace_back(sets.find(t), topology.sense(edge, triangles[t]));
  std::sort(nets.begin(), nets.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < nets.size();) {
    int sum = 0;
    const std::uint32_t set = nets[i].first;
    for (; i < nets.size() && nets[i].first == set; ++i) sum += nets[i].second;
    if (sum != 0) nets[kept++] = {set, sum};
  }
  nets.resize(kept);
}

}  // namespace

Topology make_topology(std::size_t vertices, std::span<const Triangle> triangles) {
  std::vector<std::uint32_t> first(vertices + 1, 0);
  const auto each = [&](auto&& visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t u = triangles[t][k], v = triangles[t][k == 2 ? 0 : k + 1];
        visit(std::min(u, v), std::max(u, v), static_cast<std::uint32_t>(t));
      }
  };
  each([&](std::uint32_t low, std::uint32_t, std::uint32_t) { ++first[low + 1]; });
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<HalfEdge> halves(triangles.size() * 3);
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  each([&](std::uint32_t low, std::uint32_t high, std::uint32_t t) {
    halves[next[low]++] = {high, t};
  });

  Topology topology;
  topology.edges.reserve(halves.size() / 2 + 2);
  topology.edge_triangles.reserve(halves.size());
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::span<HalfEdge> bucket = std::span(halves).subspan(first[v], first[v + 1] - first[v]);
    sort_bucket(bucket);
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      if (i == 0 || bucket[i].high != bucket[i - 1].high)
        topology.edges.push_back({static_cast<std::uint32_t>(v), bucket[i].high,
                                  static_cast<std::uint32_t>(topology.edge_triangles.size())});
      topology.edge_triangles.push_back(bucket[i].triangle);
    }
  }
  topology.edges.push_back({0, 0, static_cast<std::uint32_t>(topology.edge_triangles.size())});
  return topology;
}

ShellLabels label_shells(std::span<const Triangle> triangles, const Topology& topology) {
  Sets sets(triangles.size());
  const std::size_t edge_count = topology.edges.size() - 1;
  std::vector<std::uint32_t> open_at;  // a triangle of each edge that does not balance
  std::vector<std::size_t> crowded;    // edges with more than two triangles
  for (std::size_t e = 0; e < edge_count; ++e) {
    const auto around = topology.triangles_of(e);
    if (around.size() == 2) {
      sets.join(around[0], around[1]);
      if (topology.sense(e, triangles[around[0]]) == topology.sense(e, triangles[around[1]]))
        open_at.push_back(around[0]);
    } else if (around.size() == 1) {
      open_at.push_back(around[0]);
    } else {
      crowded.push_back(e);
    }
  }
  // What stays out of balance at a crowded edge belongs together.
  Nets nets;
  for (const std::size_t e : crowded) {
    net_senses(triangles, topology, e, sets, nets);
    for (std::size_t i = 1; i < nets.size(); ++i) sets.join(nets[0].first, nets[i].first);
  }
  for (const std::size_t e : crowded) {
    net_senses(triangles, topology, e, sets, nets);
    for (const auto& [set, net] : nets) open_at.push_back(set);
  }

  ShellLabels labels;
  labels.shell.resize(triangles.size());
  for (std::uint32_t t = 0; t < labels.shell.size(); ++t) {
    const std::uint32_t root = sets.find(t);
    labels.shell[t] = root == t ? labels.count++ : labels.shell[root];
  }
  labels.closed.assign(labels.count, 1);
  for (const std::uint32_t t : open_at) labels.closed[labels.shell[t]] = 0;
  return labels;
}

}  // namespace strake::geometry
