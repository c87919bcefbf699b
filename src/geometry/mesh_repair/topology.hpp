// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0004 says what becomes a part of an imported mesh, and why.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/union_find.hpp"
#include "geometry/mesh_repair/connectivity_cache.hpp"
#include "geometry/mesh_repair/mesh_repair.hpp"
#include "strake/geometry/part.hpp"

// The scratch memory of mesh repair, and the topology and shells of a welded mesh.

namespace strake::geometry {

/// Returns the first `count` elements of memory that is kept from mesh to mesh; their values are
/// stale.
template <class T>
[[nodiscard]] std::span<T> first_n(std::vector<T>& memory, std::size_t count) {
  if (memory.size() < count) memory.resize(count);
  return std::span(memory).first(count);
}

/// Sorts like (x, y, z): the sign bit is flipped so that unsigned order is signed order.
struct VertexKey {
  std::uint64_t xy = 0;
  std::uint32_t z = 0;
  std::uint32_t index = 0;
};

/// A triangle in a bucket sort: all but its lowest vertex, which its bucket implies.
struct TriangleKey {
  std::uint64_t mid_high = 0;  ///< the other two vertices, the lower one in the upper half
  std::uint32_t side = 0;      ///< 0: low, mid, high is its orientation; 1: low, high, mid
  std::uint32_t face = kNoIndex;

  friend auto operator<=>(const TriangleKey&, const TriangleKey&) = default;
};

struct WeldScratch {
  std::vector<std::uint64_t> packed_keys;
  std::vector<VertexKey> keys;
  std::vector<std::uint32_t> renumbered;
  std::vector<std::uint32_t> first, next;  ///< buckets of rows by lowest vertex
  std::vector<std::uint32_t> lows;         ///< of `unsorted`
  std::vector<TriangleKey> unsorted, rows;
};

struct TopologyScratch {
  std::vector<std::uint32_t> first, next;  ///< buckets of half-edges by lower vertex
  std::vector<std::uint64_t> halves;       ///< (higher vertex, triangle, 1 when it runs back)
  std::vector<PartEdge> edges;
  std::vector<std::uint32_t> edge_triangles;
  std::vector<std::uint32_t> uneven, folded;
  UnionFind sets;  ///< of triangles
};

/// The memory that repairing a mesh needs besides its result.
struct RepairScratch {
  WeldScratch weld;
  TopologyScratch topology;
  Box3i box;                         ///< of the mesh at hand
  GridMesh welded;                   ///< the mesh at hand
  GridMesh piece;                    ///< some triangles of it
  std::vector<std::uint32_t> local;  ///< number in `piece` of each vertex of `welded`
  ConnectivityCache known;
};

/// The edges of a mesh with their triangles, as Part stores them; lives in a TopologyScratch until
/// the next one is made there.
struct Topology {
  std::span<const PartEdge> edges;  ///< by (v0, v1), a sentinel at the end
  std::span<const std::uint32_t> edge_triangles;
  /// Edges, ascending, other than those with just two triangles, one along and one back.
  std::span<const std::uint32_t> uneven;
  /// Edges, ascending, of one triangle and its opposite: the borders of surfaces drawn from both
  /// sides.
  std::span<const std::uint32_t> folded;

  [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::size_t edge) const {
    const std::uint32_t first = edges[edge].first_triangle;
    return edge_triangles.subspan(first, edges[edge + 1].first_triangle - first);
  }
  /// Returns +1 when the triangle runs from v0 to v1 of the edge, -1 when it runs back.
  [[nodiscard]] int sense(std::size_t edge, const Triangle& t) const {
    return has_directed_edge(t, edges[edge].v0, edges[edge].v1) ? 1 : -1;
  }
};

/// Makes the topology of a mesh, in time linear in the number of triangles (edges are bucketed by
/// their lower vertex).
[[nodiscard]] Topology make_topology(std::size_t vertices, std::span<const Triangle> triangles,
                                     TopologyScratch& scratch);

/// The connected shells of a mesh (see repair_mesh()).
struct ShellLabels {
  std::vector<std::uint32_t> shell;  ///< of each triangle, numbered by lowest; empty: all in one
  std::uint32_t count = 0;
  std::vector<std::uint8_t> closed;  ///< per shell: 1 when its directed edges cancel
};

/// Labels the shells of a mesh; `topology` is of this mesh and in `scratch`.
[[nodiscard]] ShellLabels label_shells(std::span<const Vec3i> vertices,
                                       std::span<const Triangle> triangles,
                                       const Topology& topology, TopologyScratch& scratch);

/// Flips the triangles of closed surfaces that face the other way than the rest, the fewer ones,
/// and returns how many. This applies to surfaces with two triangles at each edge and two sides;
/// where both ways are equally many, the lowest triangle stays. The order of weld_triangles() is
/// kept, the topology has to be made anew. Linear.
[[nodiscard]] std::uint64_t orient_consistently(GridMesh& welded, const Topology& topology);

}  // namespace strake::geometry
