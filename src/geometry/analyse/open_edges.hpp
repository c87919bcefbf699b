// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/analyse/topology.hpp"

namespace strake::geometry {

/// The triangles that run along an edge, from its lower vertex to the higher one, and back.
struct OpenEdge {
  std::uint32_t low = 0, high = 0;
  std::uint32_t along = 0, back = 0;

  [[nodiscard]] bool balances() const { return along == back; }
};

[[nodiscard]] inline OpenEdge count_triangles(std::span<const Triangle> triangles,
                                              const Topology& topology, std::uint32_t edge) {
  OpenEdge counted{topology.edges[edge].v0, topology.edges[edge].v1, 0, 0};
  for (const std::uint32_t t : topology.triangles_of(edge))
    ++(topology.sense(edge, triangles[t]) > 0 ? counted.along : counted.back);
  return counted;
}

/// Those that do not balance, by their vertices.
[[nodiscard]] inline std::vector<OpenEdge> open_edges(std::span<const Triangle> triangles,
                                                      const Topology& topology) {
  std::vector<OpenEdge> open;
  for (const std::uint32_t e : topology.uneven) {
    const OpenEdge edge = count_triangles(triangles, topology, e);
    if (!edge.balances()) open.push_back(edge);
  }
  return open;
}

/// The ends of edges, ascending.
[[nodiscard]] inline std::vector<std::uint32_t> ends_of(std::span<const OpenEdge> edges) {
  std::vector<std::uint32_t> ends;
  for (const OpenEdge& e : edges) ends.insert(ends.end(), {e.low, e.high});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

}  // namespace strake::geometry
