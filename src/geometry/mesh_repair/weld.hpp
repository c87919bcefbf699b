// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0003 says why vertices and triangles are put in an order of their own.

#include <cstdint>
#include <span>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/topology.hpp"

namespace strake::geometry {

/// Fills scratch.box and the vertices of scratch.welded: those of the mesh, equal ones merged,
/// sorted by (x, y, z). Returns the new number of each old one, which lives in the scratch.
[[nodiscard]] std::span<const std::uint32_t> weld_vertices(const GridMesh& mesh,
                                                           RepairScratch& scratch);

/// Replaces the triangles of scratch.welded, whose vertices count as others of its own; those
/// without area are left out. Returns whether some triangle occurs twice.
[[nodiscard]] bool replace_triangles(const GridMesh& mesh, std::span<const std::uint32_t> vertices,
                                     RepairScratch& scratch);

/// Fills the rest of scratch.welded: degenerate and duplicate triangles dropped and counted, those
/// at T-junctions split (see split_at_t_junctions()), seams closed (see weld_within_tolerance()),
/// triangles that face the other way than the rest of a closed surface flipped (see
/// orient_consistently()), every triangle starting with its lowest vertex and triangles sorted by
/// (lowest vertex, the other two ascending, side, face); drops vertices that none of them uses.
/// Returns their topology, which lives in the scratch.
[[nodiscard]] Topology weld_triangles(const GridMesh& mesh,
                                      std::span<const std::uint32_t> renumbered, const Seams& seams,
                                      RepairScratch& scratch, RepairCounts& findings);

}  // namespace strake::geometry
