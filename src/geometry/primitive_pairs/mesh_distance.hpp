// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/primitive_pairs/solvers/primitive_operand.hpp"
#include "strake/geometry/primitive_separation.hpp"

namespace strake::geometry::primitive_pairs {

/// Returns the distance of one body, read about the mesh's origin, to the mesh's triangles: see
/// primitive_mesh_distance().
[[nodiscard]] PrimitiveMeshDistance operand_mesh_distance(const PrimitiveOperand& side,
                                                          const PartWithBvh& mesh, double cutoff);

}  // namespace strake::geometry::primitive_pairs
