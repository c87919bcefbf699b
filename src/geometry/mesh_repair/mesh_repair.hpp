// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "strake/geometry/mesh.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

/// A triangle mesh on the grid before repair: vertices may repeat, triangles may be degenerate.
struct GridMesh {
  std::vector<Vec3i> vertices;       ///< within ±2^30
  std::vector<Triangle> triangles;   ///< indices below vertices.size()
  std::vector<std::uint32_t> faces;  ///< empty, or one per triangle (TriangleMesh::faces)
};

/// Counts of what was left out of the parts or repaired.
struct RepairCounts {
  std::uint64_t degenerate_triangles = 0;  ///< of exactly zero area after the snap: left out
  std::uint64_t cut_triangles = 0;         ///< split at T-junctions, so that edges match
  std::uint64_t duplicate_triangles = 0;   ///< same vertices, same side
  std::uint64_t turned_triangles =
      0;  ///< flipped triangles of closed surfaces, which faced the other way
  std::uint64_t welded_corners = 0;    ///< vertices merged with others, or counted as on an edge
  std::uint64_t welded_shells = 0;     ///< shells that this closed
  double largest_weld = 0;             ///< grid units: how far a vertex was moved at most
  std::uint64_t nested_shells = 0;     ///< closed shells that bound nothing: a solid in a solid
  std::uint64_t two_sided_shells = 0;  ///< closed surfaces that were drawn from both sides
};

struct RepairedMesh {
  std::vector<Part> parts;
  RepairCounts findings;
};

/// The width up to which seams are closed, grid units up to a metre. Where some stay open, shells
/// that close within `first` are closed first, then those that close within twice that, and so on:
/// a shell that a small distance makes a solid is one at a large distance, too.
struct Seams {
  std::int64_t within = 0;  ///< 0: only equal vertices are merged
  std::int64_t first = within;
  friend bool operator==(const Seams&, const Seams&) = default;
};

/// Splits a mesh into parts: a solid for every nest of closed shells, oriented outward, and one
/// sheet for all shells whose edges do not balance.
///
/// 1. The result does not depend on the order of vertices or triangles, nor on which vertex a
///    triangle starts with: vertices are sorted by coordinates, triangles by vertices.
/// 2. Two triangles belong to one shell when they share an edge that has no other triangles. At an
///    edge with more, those that do not balance without it are joined across wedges of material.
///    Solids that share an edge or a face so come apart.
/// 3. A closed shell whose outermost shell has negative exact volume is flipped with all shells
///    inside it (PartFlags::inverted). Shells that do not bound {winding number >= 1} are left out
///    and counted. A surface that is drawn from both sides is the solid in it, whatever the
///    triangles of either side; the back side is left out and counted.
/// 4. Triangles of no area are left out. Where vertices lie exactly on an edge that does not match
///    those on its other side, its triangles are split there if edges then match: at T-junctions,
///    and where a triangle of no area closed the surface. Nothing moves.
/// 5. With seams wider than 0, vertices of edges that still do not match are merged where they are
///    no farther apart, and count as on such an edge where no farther from it, if edges then match:
///    this closes seams left open by the source's rounding. Meshes whose edges match do not change,
///    nor do open borders, wider gaps and bodies that would be no thicker than that.
/// 6. Of a closed surface whose edges have two triangles each, those that face the other way than
///    the rest are flipped.
/// 7. A closed shell of no volume that is covered twice, once from each side, becomes a sheet.
///
/// Every decision is exact. Cost: O(n log n) for one shell; nesting tests only shells whose boxes
/// lie inside each other.
[[nodiscard]] RepairedMesh repair_mesh(const GridMesh& mesh, const Seams& seams = {});

struct RepairScratch;

/// Repairs meshes one after another in memory that it keeps: give each worker its own, since the
/// allocations cost about as much as repairing a mesh of a hundred triangles. The results are those
/// of repair_mesh(), whatever came before.
class MeshRepairer {
 public:
  MeshRepairer();
  ~MeshRepairer();
  MeshRepairer(MeshRepairer&&) noexcept;
  MeshRepairer& operator=(MeshRepairer&&) noexcept;
  MeshRepairer(const MeshRepairer&) = delete;
  MeshRepairer& operator=(const MeshRepairer&) = delete;

  [[nodiscard]] RepairedMesh repair_mesh(const GridMesh& mesh, const Seams& seams = {});

 private:
  std::unique_ptr<RepairScratch> scratch_;
};

}  // namespace strake::geometry
