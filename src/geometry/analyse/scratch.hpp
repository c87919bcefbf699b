// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/analyse/known_meshes.hpp"
#include "strake/core/disjoint_sets.hpp"
#include "strake/geometry/analyse.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// The first `count` places of memory that is kept from mesh to mesh; what they hold is stale.
template <class T>
[[nodiscard]] std::span<T> room(std::vector<T>& memory, std::size_t count) {
  if (memory.size() < count) memory.resize(count);
  return std::span(memory).first(count);
}

/// Sorts like (x, y, z): the sign bit is flipped so that unsigned order is signed order.
struct VertexKey {
  std::uint64_t xy = 0;
  std::uint32_t z = 0;
  std::uint32_t index = 0;
};

/// A triangle on its way to its place: all but its lowest vertex, which its bucket stands for.
struct Row {
  std::uint64_t mid_high = 0;  ///< the other two vertices, the lower one in the upper half
  std::uint32_t side = 0;      ///< 0: low, mid, high is its orientation; 1: low, high, mid
  std::uint32_t face = kNoFace;

  friend auto operator<=>(const Row&, const Row&) = default;
};

struct WeldScratch {
  std::vector<std::uint64_t> packed_keys;
  std::vector<VertexKey> keys;
  std::vector<std::uint32_t> renumbered;
  std::vector<std::uint32_t> first, next;  ///< buckets of rows by lowest vertex
  std::vector<std::uint32_t> lows;         ///< of `unsorted`
  std::vector<Row> unsorted, rows;
};

struct TopologyScratch {
  std::vector<std::uint32_t> first, next;  ///< buckets of half-edges by lower vertex
  std::vector<std::uint64_t> halves;       ///< (higher vertex, triangle, 1 when it runs back)
  std::vector<PartEdge> edges;
  std::vector<std::uint32_t> edge_triangles;
  std::vector<std::uint32_t> uneven, folded;
  DisjointSets sets;  ///< of triangles
};

/// What analysing a mesh needs besides its result.
struct AnalyseScratch {
  WeldScratch weld;
  TopologyScratch topology;
  Box3i box;                         ///< of the mesh at hand
  GridMesh welded;                   ///< the mesh at hand
  GridMesh piece;                    ///< some triangles of it
  std::vector<std::uint32_t> local;  ///< number in `piece` of each vertex of `welded`
  KnownMeshes known;
};

}  // namespace strake::geometry
