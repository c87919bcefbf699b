// SPDX-License-Identifier: Apache-2.0
#include "geometry/analyse/shell_part.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/analyse/weld.hpp"

namespace strake::geometry {
namespace {

double double_area(const Vec3i& a, const Vec3i& b, const Vec3i& c) {
  const Vec3d u = b.as<double>() - a.as<double>();
  const Vec3d v = c.as<double>() - a.as<double>();
  const Vec3d n = cross(u, v);
  return std::sqrt(dot(n, n));
}

bool has_crowded_edge(const Part& part) {
  for (std::size_t e = 0; e + 1 < part.edges.size(); ++e)
    if (part.edges[e + 1].first_triangle - part.edges[e].first_triangle > 2) return true;
  return false;
}

}  // namespace

__int128 signed_volume_6(std::span<const Vec3i> vertices, std::span<const Triangle> triangles) {
  __int128 sum = 0;
  for (const Triangle& t : triangles) {
    const Vec3l a = vertices[t[0]].as<std::int64_t>();
    const Vec3l n = cross(vertices[t[1]].as<std::int64_t>(), vertices[t[2]].as<std::int64_t>());
    sum += static_cast<__int128>(a.x) * n.x + static_cast<__int128>(a.y) * n.y +
           static_cast<__int128>(a.z) * n.z;
  }
  return sum;
}

GridMesh extract(const GridMesh& mesh, std::span<const std::uint32_t> triangles) {
  std::vector<std::uint32_t> used;
  used.reserve(triangles.size() * 3);
  for (const std::uint32_t t : triangles)
    used.insert(used.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  GridMesh piece;
  piece.vertices.reserve(used.size());
  for (const std::uint32_t v : used) piece.vertices.push_back(mesh.vertices[v]);
  const auto local = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
  };
  piece.triangles.reserve(triangles.size());
  for (const std::uint32_t t : triangles) {
    const Triangle& w = mesh.triangles[t];
    piece.triangles.push_back({local(w[0]), local(w[1]), local(w[2])});
    if (!mesh.faces.empty()) piece.faces.push_back(mesh.faces[t]);
  }
  return piece;
}

Part make_part(GridMesh mesh, PartKind kind, Topology topology, ShellLabels labels) {
  Part part;
  part.kind = kind;
  part.flags.open = kind == PartKind::sheet;
  part.vertices = std::move(mesh.vertices);
  part.triangles = std::move(mesh.triangles);
  part.faces = std::move(mesh.faces);
  part.edges = std::move(topology.edges);
  part.edge_triangles = std::move(topology.edge_triangles);
  part.shells = std::move(labels.shell);
  part.shell_count = labels.count;
  part.flags.non_manifold = has_crowded_edge(part);
  for (const Vec3i& v : part.vertices) part.box.include(v);
  double area = 0;
  for (const Triangle& t : part.triangles)
    area += double_area(part.vertices[t[0]], part.vertices[t[1]], part.vertices[t[2]]);
  part.area = area / 2;
  if (kind == PartKind::solid)
    part.volume = static_cast<double>(signed_volume_6(part.vertices, part.triangles)) / 6;
  return part;
}

Part make_part(GridMesh mesh, PartKind kind) {
  Topology topology = make_topology(mesh.vertices.size(), mesh.triangles);
  ShellLabels labels = label_shells(mesh.vertices, mesh.triangles, topology);
  return make_part(std::move(mesh), kind, std::move(topology), std::move(labels));
}

void turn(std::span<Triangle> triangles) {
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
}

std::vector<std::uint32_t> single_layer(const GridMesh& mesh,
                                        std::span<const std::uint32_t> triangles) {
  // Opposites are neighbours in the order of weld().
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
