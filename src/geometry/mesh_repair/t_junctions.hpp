// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0018 says which T-junctions are cut.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/topology.hpp"

// Edges that do not balance, and the splitting of triangles at T-junctions.

namespace strake::geometry {

/// An edge that does not balance, with the numbers of triangles that run along it from its lower
/// vertex to the higher one, and back.
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

/// Returns the edges that do not balance, sorted by their vertices.
[[nodiscard]] inline std::vector<OpenEdge> open_edges(std::span<const Triangle> triangles,
                                                      const Topology& topology) {
  std::vector<OpenEdge> open;
  for (const std::uint32_t e : topology.uneven) {
    const OpenEdge edge = count_triangles(triangles, topology, e);
    if (!edge.balances()) open.push_back(edge);
  }
  return open;
}

/// Returns the ends of edges, ascending.
[[nodiscard]] inline std::vector<std::uint32_t> ends_of(std::span<const OpenEdge> edges) {
  std::vector<std::uint32_t> ends;
  for (const OpenEdge& e : edges) ends.insert(ends.end(), {e.low, e.high});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

/// The vertices at which edges of a mesh are to be split.
class EdgeCuts {
 public:
  [[nodiscard]] bool none() const { return edges_.empty(); }
  [[nodiscard]] std::size_t points() const { return points_.size(); }

  /// Adds a point for edges to be split at; add() refers to ranges of them.
  std::size_t add_point(std::uint32_t vertex);
  /// Splits the edge low-high at these points, in their order along it.
  void add(std::uint32_t low, std::uint32_t high, std::size_t first, std::size_t count);
  /// Removes what was added since there were so many points and edges.
  void drop(std::size_t points, std::size_t edges);
  [[nodiscard]] std::size_t edges() const { return edges_.size(); }
  [[nodiscard]] std::span<const std::uint32_t> points_from(std::size_t first) const {
    return std::span(points_).subspan(first);
  }
  /// Sorts the edges; call it before points_on().
  void settle(std::size_t vertices);

  /// Returns the points at which the edge between two vertices, the lower first, is to be split,
  /// from the lower on.
  [[nodiscard]] std::span<const std::uint32_t> points_on(std::uint32_t low,
                                                         std::uint32_t high) const;

 private:
  struct Edge {
    std::uint32_t low = 0, high = 0;
    std::size_t first = 0, count = 0;  ///< of points_
  };

  std::vector<std::uint32_t> points_;
  std::vector<Edge> edges_;            ///< by (low, high) once settled
  std::vector<std::uint8_t> on_edge_;  ///< per vertex: whether one of these ends there
};

/// The T-junctions of a welded mesh: where an edge a-c does not balance, and another such edge on
/// the same line ends within it and runs back along a piece of it, a-c is to be split at that end,
/// so that the two match there. An edge that only a triangle and its opposite share counts as
/// unbalanced. Incidence is exact: a vertex that the snap has moved a micrometre off an edge is not
/// on it.
///
/// Nothing moves and no point is added to the surface: edges are only split at the ends of such
/// edges. Lines on which each edge would be split at all others' ends (zigzags) are left alone.
///
/// O(k log k) for k edges that do not balance, and nothing where all do. The algorithm sweeps over
/// the intervals of each line; lines are identified by their primitive direction and moment
/// (Plücker coordinates).
class TJunctions {
 public:
  /// `vertices` are distinct and sorted by (x, y, z), so that points of one line are in order along
  /// it.
  TJunctions(std::span<const Vec3i> vertices, std::span<const Triangle> triangles,
             const Topology& topology);

  [[nodiscard]] bool none() const { return cuts_.none(); }
  [[nodiscard]] const EdgeCuts& cuts() const { return cuts_; }

 private:
  void split_edges_on_line(std::span<const OpenEdge> edges);

  EdgeCuts cuts_;
  std::vector<std::uint32_t> line_points_;  ///< memory of split_edges_on_line()
  std::vector<std::int64_t> along_, back_;
};

/// A welded mesh with some of its triangles split.
struct CutMesh {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> faces;  ///< empty, or one per triangle
  std::uint64_t cut = 0;             ///< number of triangles that were split
};

/// Returns the mesh with its triangles split where their edges are, into fans. The result depends
/// neither on the order of the triangles nor on that of their corners, and a triangle is split like
/// its opposite.
[[nodiscard]] CutMesh cut_edges(const GridMesh& welded, const EdgeCuts& cuts);

/// Returns the mesh with its triangles split at its T-junctions, into fans of triangles with an
/// area; nothing where it has none.
[[nodiscard]] std::optional<CutMesh> split_at_t_junctions(const GridMesh& welded,
                                                          const Topology& topology);

}  // namespace strake::geometry
