// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_repair/make_part.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/mesh_repair/t_junctions.hpp"
#include "geometry/mesh_repair/tolerance_weld.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/predicates/exact_normal.hpp"

namespace strake::geometry {
namespace {

double double_area(const Vec3i& a, const Vec3i& b, const Vec3i& c) {
  const Vec3d u = b.as<double>() - a.as<double>();
  const Vec3d v = c.as<double>() - a.as<double>();
  const Vec3d n = cross(u, v);
  return std::sqrt(dot(n, n));
}

/// Whether a determinant of points relative to the low corner of a box fits 64 bits: it has three
/// terms of at most the volume of the box.
bool is_small(const Box3i& box) {
  const Vec3l size = box.hi.as<std::int64_t>() - box.lo.as<std::int64_t>();
  return static_cast<__int128>(size.x) * size.y * size.z < __int128{1} << 61U;
}

/// Sum of the determinants of the corners; `Wide` holds one of them.
template <class Wide>
__int128 sum_of_determinants(std::span<const Vec3i> vertices, std::span<const Triangle> triangles,
                             const Vec3l& origin) {
  __int128 sum = 0;
  const auto corner = [&](std::uint32_t v) { return vertices[v].as<std::int64_t>() - origin; };
  for (const Triangle& t : triangles) {
    const Vec3l a = corner(t[0]);
    const Vec3l n = cross(corner(t[1]), corner(t[2]));
    sum +=
        static_cast<Wide>(a.x) * n.x + static_cast<Wide>(a.y) * n.y + static_cast<Wide>(a.z) * n.z;
  }
  return sum;
}

/// A part but for its connectivity.
Part measured_part(PartKind kind, const std::vector<Vec3i>& vertices,
                   std::span<const Triangle> triangles, __int128 volume_6) {
  Part part;
  part.kind = kind;
  part.flags.open = kind == PartKind::sheet;
  part.vertices = vertices;
  part.box = box_of(vertices);
  part.area = area_of(vertices, triangles);
  part.volume = static_cast<double>(volume_6) / 6;
  return part;
}

template <class Wide>
bool any_collinear(std::span<const Vec3i> vertices, std::span<const Triangle> triangles) {
  return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    return collinear<Wide>(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  });
}

}  // namespace

__int128 signed_volume_6(std::span<const Vec3i> vertices, std::span<const Triangle> triangles) {
  // Where the edges balance, any origin gives the same sum.
  const Box3i box = box_of(vertices);
  if (is_small(box))
    return sum_of_determinants<std::int64_t>(vertices, triangles, box.lo.as<std::int64_t>());
  return sum_of_determinants<__int128>(vertices, triangles, {});
}

double area_of(std::span<const Vec3i> vertices, std::span<const Triangle> triangles) {
  double area = 0;
  for (const Triangle& t : triangles)
    area += double_area(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  return area / 2;
}

void extract_submesh(std::span<const std::uint32_t> triangles, RepairScratch& scratch) {
  const GridMesh& mesh = scratch.welded;
  GridMesh& piece = scratch.piece;
  std::vector<std::uint32_t> used;
  used.reserve(triangles.size() * 3);
  for (const std::uint32_t t : triangles)
    used.insert(used.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  const std::span<std::uint32_t> local = first_n(scratch.local, mesh.vertices.size());
  piece.vertices.clear();
  for (const std::uint32_t v : used) {
    local[v] = static_cast<std::uint32_t>(piece.vertices.size());
    piece.vertices.push_back(mesh.vertices[v]);
  }
  piece.triangles.clear();
  piece.faces.clear();
  for (const std::uint32_t t : triangles) {
    const Triangle& w = mesh.triangles[t];
    piece.triangles.push_back({local[w[0]], local[w[1]], local[w[2]]});
    if (!mesh.faces.empty()) piece.faces.push_back(mesh.faces[t]);
  }
}

Part make_part(PartKind kind, PartSource source) {
  const GridMesh& mesh = source.mesh;
  Part part = measured_part(kind, mesh.vertices, mesh.triangles, source.volume_6);
  part.triangles = mesh.triangles;
  part.faces = mesh.faces;
  part.edges = SharedArray(source.topology.edges);
  part.edge_triangles = SharedArray(source.topology.edge_triangles);
  part.shells = std::move(source.labels.shell);
  part.shell_count = source.labels.count;
  part.flags.non_manifold = has_nonmanifold_edge(source.topology);
  return part;
}

std::optional<Part> make_known_part(const Connectivity& known, const Box3i& box,
                                    const std::vector<Vec3i>& vertices, std::int64_t weld) {
  const std::span<const Triangle> triangles = known.triangles;
  const bool degenerate = is_narrow(box) ? any_collinear<std::int64_t>(vertices, triangles)
                                         : any_collinear<__int128>(vertices, triangles);
  if (degenerate) return std::nullopt;
  const __int128 volume = known.closed ? signed_volume_6(vertices, triangles) : 0;
  if (known.closed && volume <= 0) return std::nullopt;
  const Topology topology{known.edges, known.edge_triangles, known.uneven, known.folded};
  if (!TJunctions(vertices, triangles, topology).none()) return std::nullopt;
  if (weld > 0 && may_weld_within_tolerance(vertices, triangles, topology, weld))
    return std::nullopt;
  Part part =
      measured_part(known.closed ? PartKind::solid : PartKind::sheet, vertices, triangles, volume);
  part.triangles = known.triangles;
  part.faces = known.faces;
  part.edges = known.edges;
  part.edge_triangles = known.edge_triangles;
  part.shell_count = 1;
  part.flags.inverted = known.inverted;
  return part;
}

Part make_part(PartKind kind, __int128 volume_6, RepairScratch& scratch) {
  const GridMesh& piece = scratch.piece;
  const Topology topology = make_topology(piece.vertices.size(), piece.triangles, scratch.topology);
  return make_part(
      kind, {piece, topology,
             label_shells(piece.vertices, piece.triangles, topology, scratch.topology), volume_6});
}

bool has_nonmanifold_edge(const Topology& topology) {
  return std::any_of(topology.uneven.begin(), topology.uneven.end(),
                     [&](std::uint32_t e) { return topology.triangles_of(e).size() > 2; });
}

void flip(std::span<Triangle> triangles) {
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
}

std::vector<std::uint32_t> drop_duplicate_layer(const GridMesh& mesh,
                                                std::span<const std::uint32_t> triangles) {
  // Opposites are neighbours in the order of weld_triangles().
  std::vector<std::uint32_t> layer;
  for (std::size_t i = 0; i + 1 < triangles.size(); i += 2) {
    const Triangle &a = mesh.triangles[triangles[i]], &b = mesh.triangles[triangles[i + 1]];
    if (a[0] != b[0] || a[1] != b[2] || a[2] != b[1]) break;
    layer.push_back(triangles[i]);
  }
  if (layer.size() * 2 == triangles.size()) return layer;
  return {triangles.begin(), triangles.end()};
}

}  // namespace strake::geometry
