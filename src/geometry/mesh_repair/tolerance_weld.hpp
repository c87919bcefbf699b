// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0034 says why seams close up to the precision of the source.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/near_vertices.hpp"
#include "geometry/mesh_repair/t_junctions.hpp"
#include "geometry/mesh_repair/topology.hpp"

// Closing of seams up to a tolerance: T-junctions within it, and merged vertices.

namespace strake::geometry {

/// The vertices beside edges that do not balance, at which these are to be split.
struct NearTJunctions {
  EdgeCuts cuts;
  std::vector<std::uint32_t> corners;  ///< vertices at which edges are split, ascending
  double largest = 0;                  ///< grid units: the farthest of them from its edge
  bool tangled = false;                ///< no result, as all edges pass all vertices
};

/// Returns the T-junctions of a welded mesh whose vertex lies within `within` of the edge, and of
/// neither end: a vertex is kept where a piece of the edge beside it then matches another that runs
/// back, and no fewer pieces would stay open without it. `may_cut`: per vertex, 1 for vertices to
/// split at, and for ends of edges that may be split. Nothing where that takes far more work than
/// faces of solids would.
[[nodiscard]] NearTJunctions find_near_t_junctions(const GridMesh& welded, const Topology& topology,
                                                   const NearPoints& points,
                                                   const std::vector<std::uint8_t>& may_cut,
                                                   std::int64_t within);

/// The effect of weld_within_tolerance() on a mesh.
struct ToleranceWeld {
  std::uint64_t corners = 0;  ///< vertices merged with others, or counted as on an edge
  std::uint64_t shells = 0;   ///< shells that this closed
  double largest = 0;         ///< grid units: the largest displacement of a vertex
  bool repeated = false;      ///< some triangle comes twice now
};

/// The seams to close: all, or only those that make a shell closed, with the vertices of the others
/// unchanged.
enum class Closing : std::uint8_t { all, whole_shells };

/// Whether any vertex of an edge that does not balance is within `within` of another such edge.
[[nodiscard]] bool may_weld_within_tolerance(std::span<const Vec3i> vertices,
                                             std::span<const Triangle> triangles,
                                             const Topology& topology, std::int64_t within);

/// Closes the seams of scratch.welded, whose topology this is, up to the tolerance: vertices of
/// edges that do not balance are merged where no farther apart than `within`, and count as on such
/// an edge where no farther from it. Returns nothing, and leaves the mesh as it was, where that
/// closes no seam; else the mesh and its topology are new, with some vertices unused.
///
/// 1. Vertices connected in this way, each near the next, move to the one nearest to their middle,
///    unless one would move farther than `within`: a chain of them, as on a fine border, stays as
///    it is.
/// 2. An edge is split at a vertex beside it only where a piece then matches one that runs back;
///    the vertex does not move.
/// 3. A vertex at which this makes no two edges match does not move: the border of a plate, a box
///    without a lid and a hole smaller than the tolerance stay. A body that would become no thicker
///    than `within` stays too: two surfaces back to back are no solid.
/// 4. The result depends on the set of triangles and on differences of coordinates alone. It is
///    exact, but for the thickness, which is floating point.
///
/// O(k log k) for k edges that do not balance, as long as few vertices are near each of them;
/// nothing where all balance. Surface modellers know this as sewing, here by clusters of vertices.
[[nodiscard]] std::optional<ToleranceWeld> weld_within_tolerance(std::int64_t within,
                                                                 Closing closing,
                                                                 Topology& topology,
                                                                 RepairScratch& scratch);

}  // namespace strake::geometry
