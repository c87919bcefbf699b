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

/// Where edges of a mesh are to be cut.
class EdgeCuts {
 public:
  [[nodiscard]] bool none() const { return edges_.empty(); }
  [[nodiscard]] std::size_t points() const { return points_.size(); }

  /// Points for edges to be cut at; add() names stretches of them.
  std::size_t add_point(std::uint32_t vertex);
  /// The edge low-high is cut at these points, in their order along it.
  void add(std::uint32_t low, std::uint32_t high, std::size_t first, std::size_t count);
  /// Takes back what was added since there were so many points and edges.
  void drop(std::size_t points, std::size_t edges);
  [[nodiscard]] std::size_t edges() const { return edges_.size(); }
  [[nodiscard]] std::span<const std::uint32_t> points_from(std::size_t first) const {
    return std::span(points_).subspan(first);
  }
  /// To be called before points_on().
  void settle(std::size_t vertices);

  /// Where the edge between two vertices, the lower first, is to be cut, from the lower on.
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

/// The T-junctions of a welded mesh: where an edge a-c does not balance, and another of the same
/// line that does not either ends within it and runs back along a piece of it, a-c is to be cut at
/// that end, so that the two match there. An edge that only a triangle and its opposite have is
/// balanced by nothing. Incidence is exact: a corner that the snap has taken a micrometre off an
/// edge is none on it.
///
/// Nothing moves and no point is added to the surface: only the ends of such edges are places to
/// cut at. Lines on which everybody is to be cut at everybody else's ends (zigzags) are left alone.
///
/// O(k log k) for k edges that do not balance, and nothing where all do. Source of the algorithm: a
/// sweep over the intervals of each line; lines are told by their primitive direction and moment
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
  void look_at_line(std::span<const OpenEdge> edges);

  EdgeCuts cuts_;
  std::vector<std::uint32_t> line_points_;  ///< memory of look_at_line()
  std::vector<std::int64_t> along_, back_;
};

/// A welded mesh with some of its triangles cut.
struct CutMesh {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> faces;  ///< empty, or one per triangle
  std::uint64_t cut = 0;             ///< triangles that became several
};

/// The mesh with its triangles cut where their edges are to be, in fans. Depends neither on the
/// order of the triangles nor on their corners', and a triangle is cut like its opposite.
[[nodiscard]] CutMesh cut_edges(const GridMesh& welded, const EdgeCuts& cuts);

/// The mesh with its triangles cut at its T-junctions, in fans that have an area each; nothing
/// where it has none.
[[nodiscard]] std::optional<CutMesh> split_at_t_junctions(const GridMesh& welded,
                                                          const Topology& topology);

}  // namespace strake::geometry
