// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "strake/core/shared_array.hpp"
#include "strake/geometry/mesh.hpp"
#include "strake/geometry/primitive.hpp"
#include "strake/geometry/vec.hpp"

namespace strake::geometry {

enum class PartKind : std::uint8_t {
  solid,  ///< directed edges cancel: the part bounds a volume
  sheet,  ///< open or edge-unbalanced surface
  wire,   ///< polylines: drawn, and checked for clashes only on request
};

/// What mesh repair found in a part; each flag is passed on to the results that the part takes part
/// in.
struct PartFlags {
  bool inverted : 1 = false;      ///< came inside out (negative exact volume) and was flipped
  bool open : 1 = false;          ///< a sheet because edges lack their partners
  bool non_manifold : 1 = false;  ///< an edge with other than two triangles
  bool unknown_sag : 1 = false;   ///< how far the mesh lies from its surface is not known
};

/// An edge of a part between two welded vertices, v0 < v1. Its triangles are
/// Part::edge_triangles[first_triangle .. next edge's first_triangle), ascending.
struct PartEdge {
  std::uint32_t v0 = 0, v1 = 0;
  std::uint32_t first_triangle = 0;
};

/// One part on the grid: an analytic primitive's tessellation, or a nest of mesh shells (an
/// outermost shell and all shells inside it), welded and oriented outward.
///
/// Coordinates are grid units relative to the origin of the body that places the part, within
/// ±2^30. Everything exact (clash signs, hidden-line decisions) is decided on these integers.
///
/// The connectivity may be shared with other parts: a plant has its pipes, flanges and profiles in
/// a hundred sizes and a few connectivities.
struct Part {
  PartKind kind = PartKind::solid;
  PartFlags flags;
  std::vector<Vec3i> vertices;      ///< no two equal
  SharedArray<Triangle> triangles;  ///< none degenerate; outward counter-clockwise for solids
  SharedArray<std::uint32_t>
      faces;                    ///< source face of each triangle; empty: each is a face of its own
  SharedArray<PartEdge> edges;  ///< sorted by (v0, v1); one sentinel at the end
  SharedArray<std::uint32_t> edge_triangles;
  /// Shell (connected through edges) of each triangle, 0-based; empty: one shell.
  SharedArray<std::uint32_t> shells;
  std::uint32_t shell_count = 0;
  std::vector<std::uint32_t> chain_first;  ///< wires: chain i is vertices[chain_first[i]..[i+1])
  Box3i box = empty_box<std::int32_t>();

  /// The primitive that the triangles stand for, in the local frame of its body, if analytic.
  std::optional<Primitive> primitive;
  double sag = 0;     ///< grid units: bound on the distance between triangles and true surface
  double weld = 0;    ///< the share of `sag` by which closing seams may have moved vertices
  double volume = 0;  ///< cubic grid units (solids), rounded from the exact value
  double area = 0;    ///< square grid units
  /// Returns 2·volume/area in grid units: t for a plate of thickness t, 0 for sheets and wires.
  [[nodiscard]] double thickness() const { return area > 0 ? 2 * volume / area : 0; }
};

/// A part and its position: world grid coordinate = origin + vertex.
struct PlacedPart {
  const Part* part = nullptr;
  Vec3l origin;
};

// Queries about the edges of a part and their triangles.

/// Returns the number of the edge between two vertices; kNoIndex where there is none.
[[nodiscard]] inline std::uint32_t edge_between(const Part& part, std::uint32_t u,
                                                std::uint32_t v) {
  const std::uint32_t low = std::min(u, v), high = std::max(u, v);
  const auto end = part.edges.end() - 1;  // the sentinel
  const auto it = std::lower_bound(
      part.edges.begin(), end, std::pair(low, high),
      [](const PartEdge& e, const auto& key) { return std::pair(e.v0, e.v1) < key; });
  if (it == end || it->v0 != low || it->v1 != high) return kNoIndex;
  return static_cast<std::uint32_t>(it - part.edges.begin());
}

/// Returns the triangles that share an edge, ascending.
[[nodiscard]] inline std::span<const std::uint32_t> incident_triangles(const Part& part,
                                                                       std::uint32_t edge) {
  const PartEdge &e = part.edges[edge], &next = part.edges[std::size_t{edge} + 1];
  return std::span(part.edge_triangles)
      .subspan(e.first_triangle, next.first_triangle - e.first_triangle);
}

/// Whether a triangle with both vertices runs from the first to the second, not back.
[[nodiscard]] constexpr bool has_directed_edge(const Triangle& t, std::uint32_t u,
                                               std::uint32_t v) {
  return (t[0] == u && t[1] == v) || (t[1] == u && t[2] == v) || (t[2] == u && t[0] == v);
}

/// Returns the vertex of a triangle at an edge that is not on the edge.
[[nodiscard]] constexpr std::uint32_t opposite_vertex(const Triangle& t, const PartEdge& edge) {
  for (const std::uint32_t v : t)
    if (v != edge.v0 && v != edge.v1) return v;
  return edge.v0;
}

}  // namespace strake::geometry
