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

namespace strake::geometry {

/// Where edges that do not balance are to be cut at corners beside them.
struct NearTJunctions {
  EdgeCuts cuts;
  std::vector<std::uint32_t> corners;  ///< that edges are cut at, ascending
  double largest = 0;                  ///< grid units: the farthest of them from its edge
  bool tangled = false;                ///< nothing, as all edges run past all corners
};

/// The T-junctions of a welded mesh whose corner lies within `within` of the edge, and of neither
/// end: a corner is kept where a piece of the edge beside it so matches another that runs back, and
/// no fewer pieces would be left open without it.
/// `may_cut`: per vertex, 1 for corners to cut at, and for ends of edges that may be cut. Nothing
/// where that takes far more than faces of solids would.
[[nodiscard]] NearTJunctions find_near_t_junctions(const GridMesh& welded, const Topology& topology,
                                                   const NearPoints& points,
                                                   const std::vector<std::uint8_t>& may_cut,
                                                   std::int64_t within);

/// What weld_within_tolerance() did to a mesh.
struct ToleranceWeld {
  std::uint64_t corners = 0;  ///< that count as one with others, or as on an edge
  std::uint64_t shells = 0;   ///< that are closed so
  double largest = 0;         ///< grid units: how far a corner lay from where it counts
  bool repeated = false;      ///< some triangle comes twice now
};

/// Which seams close: all, or those alone that make a shell closed, the corners of the others as
/// they came.
enum class Closing : std::uint8_t { all, whole_shells };

/// Whether any corner of an edge that does not balance is as near as that to another such edge.
[[nodiscard]] bool may_weld_within_tolerance(std::span<const Vec3i> vertices,
                                             std::span<const Triangle> triangles,
                                             const Topology& topology, std::int64_t within);

/// Closes the seams of scratch.welded, whose topology this is, where the source's numbers do not
/// hold them open: corners of edges that do not balance count as one where no farther apart than
/// `within`, and as on such an edge where no farther from it. Nothing, and the mesh as it was,
/// where that closes no seam; else the mesh and its topology are new, some vertices unused.
///
/// 1. Corners that hang together so, each near the next, move to the one nearest to their middle,
///    unless one would move farther than `within`: a chain of them, a fine rim, stays as it is.
/// 2. An edge is cut at a corner beside it only where a piece then matches one that runs back; the
///    corner does not move.
/// 3. A corner at which no two edges come to match by it does not move: the rim of a plate, a box
///    without a lid and a hole too small for its corners stay. What would become no thicker than
///    `within` stays too: two skins back to back are no solid.
/// 4. Depends on the set of triangles alone, and on differences of coordinates. Exact, but for the
///    thickness, which is floating point.
///
/// O(k log k) for k edges that do not balance, as long as few corners are near each of them;
/// nothing where all balance. Sewing, as modellers of surfaces know it, by clusters of corners.
[[nodiscard]] std::optional<ToleranceWeld> weld_within_tolerance(std::int64_t within,
                                                                 Closing closing,
                                                                 Topology& topology,
                                                                 RepairScratch& scratch);

}  // namespace strake::geometry
