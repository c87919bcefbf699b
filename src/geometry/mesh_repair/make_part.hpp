// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/mesh_repair/mesh_repair.hpp"
#include "geometry/mesh_repair/topology.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {

/// Returns six times the exact signed volume under triangles whose edges balance. It fits:
/// |coordinate| <= 2^30 makes a term at most 2^93, and there are below 2^32 of them.
[[nodiscard]] __int128 signed_volume_6(std::span<const Vec3i> vertices,
                                       std::span<const Triangle> triangles);

[[nodiscard]] double area_of(std::span<const Vec3i> vertices, std::span<const Triangle> triangles);

/// Fills scratch.piece: some triangles of scratch.welded, in its order, with the vertices that they
/// use.
void extract_submesh(std::span<const std::uint32_t> triangles, RepairScratch& scratch);

/// The source of a part: a welded mesh whose vertices are all used, its topology and its shells,
/// and six times the volume (0 for sheets).
struct PartSource {
  const GridMesh& mesh;
  const Topology& topology;
  ShellLabels labels;
  __int128 volume_6 = 0;
};
[[nodiscard]] Part make_part(PartKind kind, PartSource source);

/// Makes the part of scratch.piece.
[[nodiscard]] Part make_part(PartKind kind, __int128 volume_6, RepairScratch& scratch);

/// Makes the part of a welded mesh in this box with a known connectivity, if that applies
/// unchanged: no triangle is degenerate, a closed mesh has the same orientation, and an open one
/// has no edges to match, exactly or within `weld`.
[[nodiscard]] std::optional<Part> make_known_part(const Connectivity& known, const Box3i& box,
                                                  const std::vector<Vec3i>& vertices,
                                                  std::int64_t weld);

/// Whether an edge has more than two triangles.
[[nodiscard]] bool has_nonmanifold_edge(const Topology& topology);

/// Flips every triangle.
void flip(std::span<Triangle> triangles);

/// Returns the given triangles of a welded mesh; of a surface covered twice throughout, once from
/// each side, only one layer.
[[nodiscard]] std::vector<std::uint32_t> drop_duplicate_layer(
    const GridMesh& mesh, std::span<const std::uint32_t> triangles);

}  // namespace strake::geometry
