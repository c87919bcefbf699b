// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/analyse/scratch.hpp"
#include "strake/geometry/analyse.hpp"

namespace strake::geometry {

/// Fills scratch.welded: the mesh with equal vertices made one, vertices sorted by (x, y, z),
/// unused ones dropped, degenerate and duplicate triangles dropped and counted, every triangle
/// starting with its lowest vertex and triangles sorted by (lowest vertex, the other two ascending,
/// side, face).
void weld(const GridMesh& mesh, AnalyseScratch& scratch, MeshFindings& findings);

}  // namespace strake::geometry
