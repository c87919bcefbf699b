// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "strake/geometry/analyse.hpp"

namespace strake::geometry {

/// The mesh with equal vertices made one, vertices sorted by (x, y, z), unused ones dropped,
/// degenerate and duplicate triangles dropped and counted, every triangle starting with its lowest
/// vertex and triangles sorted by (lowest vertex, the other two ascending, side, face).
[[nodiscard]] GridMesh weld(const GridMesh& mesh, MeshFindings& findings);

/// Drops vertices that no triangle uses, keeping the order of the others.
void drop_unused_vertices(GridMesh& mesh);

}  // namespace strake::geometry
