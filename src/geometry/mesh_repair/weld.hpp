// SPDX-License-Identifier: Apache-2.0
#pragma once

// Decision 0003 says why vertices and triangles are put in an order of their own.

#include <cstdint>
#include <span>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/topology.hpp"

namespace strake::geometry {

/// Fills scratch.box and the vertices of scratch.welded: those of the mesh, equal ones made one,
/// sorted by (x, y, z). Returns the new number of each old one, which lives in the scratch.
[[nodiscard]] std::span<const std::uint32_t> weld_vertices(const GridMesh& mesh,
                                                           RepairScratch& scratch);

/// Puts other triangles into scratch.welded, of vertices that count as these of its own; those
/// without area are left out. Whether some triangle comes twice.
[[nodiscard]] bool replace_triangles(const GridMesh& mesh, std::span<const std::uint32_t> vertices,
                                     RepairScratch& scratch);

/// Fills the rest of scratch.welded: degenerate and duplicate triangles dropped and counted, those
/// at T-junctions cut (see split_at_t_junctions()), seams closed (see weld_within_tolerance()),
/// triangles that face the other way than the rest of a closed surface turned (see
/// orient_consistently()), every triangle starting with its lowest vertex and triangles sorted by
/// (lowest vertex, the other two ascending, side, face); drops vertices that none of them uses.
/// Returns their topology, which lives in the scratch.
[[nodiscard]] Topology weld_triangles(const GridMesh& mesh,
                                      std::span<const std::uint32_t> renumbered, const Seams& seams,
                                      RepairScratch& scratch, RepairCounts& findings);

}  // namespace strake::geometry
