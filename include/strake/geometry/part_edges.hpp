// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "strake/geometry/part.hpp"

namespace strake::geometry {

// How the edges of a part and its triangles lie to each other.

/// The number of the edge between two vertices; kNoFace where there is none.
[[nodiscard]] inline std::uint32_t edge_between(const Part& part, std::uint32_t u,
                                                std::uint32_t v) {
  const std::uint32_t low = std::min(u, v), high = std::max(u, v);
  const auto end = part.edges.end() - 1;  // the sentinel
  const auto it = std::lower_bound(
      part.edges.begin(), end, std::pair(low, high),
      [](const PartEdge& e, const auto& key) { return std::pair(e.v0, e.v1) < key; });
  if (it == end || it->v0 != low || it->v1 != high) return kNoFace;
  return static_cast<std::uint32_t>(it - part.edges.begin());
}

/// The triangles round an edge.
[[nodiscard]] inline std::span<const std::uint32_t> triangles_round(const Part& part,
                                                                    std::uint32_t edge) {
  const PartEdge &e = part.edges[edge], &next = part.edges[std::size_t{edge} + 1];
  return std::span(part.edge_triangles)
      .subspan(e.first_triangle, next.first_triangle - e.first_triangle);
}

/// Whether a triangle with both vertices runs from the first to the second, not back.
[[nodiscard]] constexpr bool runs_along(const Triangle& t, std::uint32_t u, std::uint32_t v) {
  return (t[0] == u && t[1] == v) || (t[1] == u && t[2] == v) || (t[2] == u && t[0] == v);
}

/// The corner of a triangle round an edge that is not on it.
[[nodiscard]] constexpr std::uint32_t corner_off(const Triangle& t, const PartEdge& edge) {
  for (const std::uint32_t v : t)
    if (v != edge.v0 && v != edge.v1) return v;
  return edge.v0;
}

}  // namespace strake::geometry
