// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/near_walk.hpp"
#include "strake/core/disjoint_sets.hpp"

namespace strake::geometry {

/// One of two parts whose near triangles are known.
struct PlacesSide {
  const PartView& own;
  const PartView& other;
  bool is_a = true;  ///< whether `own` is the first of the two

  [[nodiscard]] std::uint32_t own_of(const NearTriangles& p) const { return is_a ? p.a : p.b; }
  [[nodiscard]] std::uint32_t other_of(const NearTriangles& p) const { return is_a ? p.b : p.a; }
};

/// The pairs of near triangles as one side sees them: grouped by its own triangles.
struct SidePairs {
  std::vector<std::uint32_t> order;  ///< of the pairs, by (own triangle, pair)
  std::vector<std::uint32_t> row;    ///< by pair: the number of its own triangle's group
  std::vector<std::uint32_t> first;  ///< by row: into `order`; one more at the end
  std::vector<std::array<std::uint32_t, 3>> edges;  ///< by row: of the triangle, kNoFace for none

  [[nodiscard]] std::span<const std::uint32_t> group(std::size_t r) const {
    return std::span(order).subspan(first[r], first[r + 1] - first[r]);
  }
};

[[nodiscard]] SidePairs grouped(const PlacesSide& side, std::span<const NearTriangles> pairs);

/// Joins pairs that have a triangle of `side` in common and whose other triangles share an edge or
/// a corner within reach of it. Returns how many sets fewer there are.
std::size_t join_round_triangles(const PlacesSide& side, const SidePairs& own,
                                 const SidePairs& other, std::span<const NearTriangles> pairs,
                                 double reach, DisjointSets& sets);

/// An edge of one part near a triangle of the other, as one of the pairs of near triangles round it
/// has it.
struct EdgeStop {
  std::uint32_t edge = 0;
  std::uint32_t other = 0;  ///< the other part's triangle
  std::uint32_t pair = 0;   ///< index into the pairs
  double along = 0;         ///< where it is nearest: 0 at the edge's v0, 1 at its v1
};

/// All stops within `reach` on the edges of a side, by (edge, other, pair).
[[nodiscard]] std::vector<EdgeStop> edge_stops(const PlacesSide& side, const SidePairs& own,
                                               std::span<const NearTriangles> pairs, double reach);

}  // namespace strake::geometry
