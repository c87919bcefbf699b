// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/analyse/scratch.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/part_edges.hpp"

namespace strake::geometry {

/// The edges of a mesh with their triangles, as Part stores them; lives in a TopologyScratch until
/// the next one is made there.
struct Topology {
  std::span<const PartEdge> edges;  ///< by (v0, v1), a sentinel at the end
  std::span<const std::uint32_t> edge_triangles;
  /// Edges, ascending, that do not have just two triangles, one along and one back.
  std::span<const std::uint32_t> uneven;
  /// Edges, ascending, of one triangle and its opposite: the rims of what is drawn from both sides.
  std::span<const std::uint32_t> folded;

  [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::size_t edge) const {
    const std::uint32_t first = edges[edge].first_triangle;
    return edge_triangles.subspan(first, edges[edge + 1].first_triangle - first);
  }
  /// +1 when the triangle runs from v0 to v1 of the edge, -1 when it runs back.
  [[nodiscard]] int sense(std::size_t edge, const Triangle& t) const {
    return runs_along(t, edges[edge].v0, edges[edge].v1) ? 1 : -1;
  }
};

/// Linear in the number of triangles (edges are bucketed by their lower vertex).
[[nodiscard]] Topology make_topology(std::size_t vertices, std::span<const Triangle> triangles,
                                     TopologyScratch& scratch);

/// The connected shells of a mesh (see analyse()).
struct ShellLabels {
  std::vector<std::uint32_t> shell;  ///< of each triangle, numbered by lowest; empty: all in one
  std::uint32_t count = 0;
  std::vector<std::uint8_t> closed;  ///< per shell: 1 when its directed edges cancel
};

/// `topology` is of this mesh and in `scratch`.
[[nodiscard]] ShellLabels label_shells(std::span<const Vec3i> vertices,
                                       std::span<const Triangle> triangles,
                                       const Topology& topology, TopologyScratch& scratch);

}  // namespace strake::geometry
