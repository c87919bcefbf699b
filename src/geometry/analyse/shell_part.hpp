// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/analyse/topology.hpp"
#include "strake/geometry/analyse.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// Six times the exact signed volume under triangles whose edges balance.
/// Fits: |coordinate| <= 2^30 makes a term at most 2^93, and there are below 2^32 of them.
[[nodiscard]] __int128 signed_volume_6(std::span<const Vec3i> vertices,
                                       std::span<const Triangle> triangles);

/// The part made of some triangles of a welded mesh, in the mesh's order.
[[nodiscard]] GridMesh extract(const GridMesh& mesh, std::span<const std::uint32_t> triangles);

/// A part of a welded mesh whose vertices are all used. `topology` and `labels` are of that mesh.
[[nodiscard]] Part make_part(GridMesh mesh, PartKind kind, Topology topology, ShellLabels labels);
[[nodiscard]] Part make_part(GridMesh mesh, PartKind kind);

/// Turns every triangle over.
void turn(std::span<Triangle> triangles);

/// The given triangles of a welded mesh; of a surface that is covered twice throughout, once from
/// each side, only one layer.
[[nodiscard]] std::vector<std::uint32_t> single_layer(const GridMesh& mesh,
                                                      std::span<const std::uint32_t> triangles);

}  // namespace strake::geometry
