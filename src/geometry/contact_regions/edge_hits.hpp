// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/union_find.hpp"
#include "geometry/distance/distance_traversal.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "strake/geometry/vec.hpp"

// Hits of edges on near triangles, and near pairs grouped by triangle.

namespace strake::geometry {

/// Returns the parameter, from 0 at the start to 1 at the end, at which a segment comes nearest to
/// a triangle, if that is within reach (whose square is given). In double arithmetic, off by some
/// roundings of the coordinates.
[[nodiscard]] std::optional<double> nearest_parameter(const Vec3d& from, const Vec3d& to,
                                                      const Corners& t, double squared_reach);

/// One of two parts whose near triangles are known.
struct RegionSide {
  const PairLocalPart& own;
  const PairLocalPart& other;
  bool is_a = true;  ///< whether `own` is the first of the two

  [[nodiscard]] std::uint32_t own_of(const NearTrianglePair& p) const { return is_a ? p.a : p.b; }
  [[nodiscard]] std::uint32_t other_of(const NearTrianglePair& p) const { return is_a ? p.b : p.a; }
};

/// The pairs of near triangles as one side sees them: grouped by its own triangles.
struct PairsByTriangle {
  std::vector<std::uint32_t> order;  ///< of the pairs, by (own triangle, pair)
  std::vector<std::uint32_t> row;    ///< by pair: the number of its own triangle's group
  std::vector<std::uint32_t> first;  ///< by row: into `order`; one more at the end
  std::vector<std::array<std::uint32_t, 3>> edges;  ///< by row: of the triangle, kNoIndex for none

  [[nodiscard]] std::span<const std::uint32_t> group(std::size_t r) const {
    return std::span(order).subspan(first[r], first[r + 1] - first[r]);
  }
};

[[nodiscard]] PairsByTriangle grouped(const RegionSide& side,
                                      std::span<const NearTrianglePair> pairs);

/// Unites pairs that share a triangle of `side` and whose other triangles share an edge or a vertex
/// within reach of it. Returns by how many the number of sets falls.
std::size_t join_around_triangles(const RegionSide& side, const PairsByTriangle& own,
                                  const PairsByTriangle& other,
                                  std::span<const NearTrianglePair> pairs, double reach,
                                  UnionFind& sets);

/// An edge of one part near a triangle of the other, for one of the near pairs at that edge.
struct EdgeHit {
  std::uint32_t edge = 0;
  std::uint32_t other = 0;  ///< the other part's triangle
  std::uint32_t pair = 0;   ///< index into the pairs
  double along = 0;         ///< where the edge is nearest: 0 at its v0, 1 at its v1
};

/// Returns all hits within `reach` of the edges of a side, sorted by (edge, other, pair).
[[nodiscard]] std::vector<EdgeHit> edge_hits(const RegionSide& side, const PairsByTriangle& own,
                                             std::span<const NearTrianglePair> pairs, double reach);

}  // namespace strake::geometry
