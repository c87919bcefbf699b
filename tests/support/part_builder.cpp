// SPDX-License-Identifier: Apache-2.0
#include "support/part_builder.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/union_find.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::testing {

using geometry::Part;
using geometry::PartKind;
using geometry::Triangle;
using geometry::Vec3d;
using geometry::Vec3i;
using geometry::Vec3l;

namespace {

using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;

void weld(const IndexedMesh& mesh, Part& part) {
  std::map<Vec3i, std::uint32_t> index;
  std::vector<std::uint32_t> to;
  for (const Vec3i& v : mesh.vertices) {
    const auto [it, fresh] = index.emplace(v, static_cast<std::uint32_t>(part.vertices.size()));
    if (fresh) part.vertices.push_back(v);
    to.push_back(it->second);
    part.box.include(v);
  }
  std::vector<Triangle> triangles;
  for (const Triangle& t : mesh.triangles) {
    const Triangle w{to[t[0]], to[t[1]], to[t[2]]};
    const Vec3l a = part.vertices[w[0]].as<std::int64_t>();
    const Vec3l u = part.vertices[w[1]].as<std::int64_t>() - a;
    const Vec3l v = part.vertices[w[2]].as<std::int64_t>() - a;
    const auto n = geometry::cross_exact(u, v);
    if (n.x != 0 || n.y != 0 || n.z != 0) triangles.push_back(w);
  }
  part.triangles = std::move(triangles);
}

std::map<EdgeKey, std::vector<std::uint32_t>> edge_map(const Part& part, bool& balanced) {
  std::map<EdgeKey, std::vector<std::uint32_t>> edges;
  std::map<EdgeKey, int> balance;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t u = part.triangles[t][i], v = part.triangles[t][(i + 1) % 3];
      const EdgeKey key{std::min(u, v), std::max(u, v)};
      edges[key].push_back(t);
      balance[key] += u < v ? 1 : -1;
    }
  balanced = std::ranges::all_of(balance, [](const auto& entry) { return entry.second == 0; });
  return edges;
}

void number_shells(Part& part, const std::map<EdgeKey, std::vector<std::uint32_t>>& edges) {
  UnionFind sets(part.triangles.size());
  for (const auto& [key, triangles] : edges)
    for (const std::uint32_t t : triangles) sets.join(t, triangles.front());
  std::map<std::uint32_t, std::uint32_t> number;
  std::vector<std::uint32_t> shells;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t)
    shells.push_back(
        number.emplace(sets.root(t), static_cast<std::uint32_t>(number.size())).first->second);
  part.shells = std::move(shells);
  part.shell_count = static_cast<std::uint32_t>(number.size());
}

}  // namespace

void IndexedMesh::append(const IndexedMesh& other) {
  const auto base = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.triangles)
    triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

IndexedMesh IndexedMesh::flipped() const {
  IndexedMesh r = *this;
  for (Triangle& t : r.triangles) std::swap(t[1], t[2]);
  return r;
}

Part build_part(const IndexedMesh& mesh) {
  Part part;
  weld(mesh, part);
  bool balanced = true;
  const auto edges = edge_map(part, balanced);
  part.kind = balanced ? PartKind::solid : PartKind::sheet;
  part.flags.open = !balanced;
  std::vector<geometry::PartEdge> part_edges;
  std::vector<std::uint32_t> edge_triangles;
  for (const auto& [key, triangles] : edges) {
    part_edges.push_back(
        {key.first, key.second, static_cast<std::uint32_t>(edge_triangles.size())});
    edge_triangles.insert(edge_triangles.end(), triangles.begin(), triangles.end());
  }
  part_edges.push_back({0, 0, static_cast<std::uint32_t>(edge_triangles.size())});
  part.edges = std::move(part_edges);
  part.edge_triangles = std::move(edge_triangles);
  number_shells(part, edges);
  return part;
}

IndexedMesh box_mesh(const Vec3i& lo, const Vec3i& hi) {
  IndexedMesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back(
        {(i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z});
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

IndexedMesh quad_mesh(const Vec3i& p, const Vec3i& u, const Vec3i& v) {
  return {{p, p + u, p + u + v, p + v}, {{0, 1, 2}, {0, 2, 3}}};
}

IndexedMesh prism_mesh(std::span<const Vec3i> polygon, std::int32_t z0, std::int32_t z1) {
  IndexedMesh m;
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (const std::int32_t z : {z0, z1})
    for (const Vec3i& p : polygon) m.vertices.push_back({p.x, p.y, z});
  for (std::uint32_t i = 2; i < n; ++i) {
    m.triangles.push_back({0, i, i - 1});
    m.triangles.push_back({n, n + i - 1, n + i});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    m.triangles.push_back({i, j, n + j});
    m.triangles.push_back({i, n + j, n + i});
  }
  return m;
}

}  // namespace strake::testing
