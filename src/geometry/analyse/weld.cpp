// SPDX-License-Identifier: Apache-2.0
#include "geometry/analyse/weld.hpp"

#include <algorithm>
#include <cstddef>

#include "geometry/analyse/topology.hpp"

namespace strake::geometry {
namespace {

/// Sorts like (x, y, z): the sign bit is flipped so that unsigned order is signed order.
struct VertexKey {
  std::uint64_t xy = 0;
  std::uint32_t z = 0;
  std::uint32_t index = 0;
};

constexpr std::uint32_t ordered(std::int32_t value) {
  return static_cast<std::uint32_t>(value) ^ 0x80000000U;
}

/// Fills `welded.vertices`; returns the new index of every old vertex.
std::vector<std::uint32_t> weld_vertices(const std::vector<Vec3i>& vertices,
                                         std::vector<Vec3i>& welded) {
  std::vector<VertexKey> keys(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3i& v = vertices[i];
    keys[i] = {(std::uint64_t{ordered(v.x)} << 32U) | ordered(v.y), ordered(v.z),
               static_cast<std::uint32_t>(i)};
  }
  std::sort(keys.begin(), keys.end(), [](const VertexKey& a, const VertexKey& b) {
    return a.xy != b.xy ? a.xy < b.xy : a.z < b.z;
  });
  std::vector<std::uint32_t> renumbered(vertices.size());
  welded.reserve(vertices.size());
  for (const VertexKey& key : keys) {
    const Vec3i& v = vertices[key.index];
    if (welded.empty() || welded.back() != v) welded.push_back(v);
    renumbered[key.index] = static_cast<std::uint32_t>(welded.size() - 1);
  }
  return renumbered;
}

/// Cross products of edge vectors; `Wide` holds the square of twice the extent.
template <class Wide>
bool collinear(const Vec3i& a, const Vec3i& b, const Vec3i& c) {
  const Wide ux = Wide{b.x} - a.x, uy = Wide{b.y} - a.y, uz = Wide{b.z} - a.z;
  const Wide vx = Wide{c.x} - a.x, vy = Wide{c.y} - a.y, vz = Wide{c.z} - a.z;
  return uy * vz == uz * vy && uz * vx == ux * vz && ux * vy == uy * vx;
}

/// A triangle on its way to its place: starts with its lowest vertex.
struct Row {
  std::uint32_t low = 0, mid = 0, high = 0;
  std::uint32_t side = 0;  ///< 0: low, mid, high is its orientation; 1: low, high, mid
  std::uint32_t face = kNoFace;

  friend auto operator<=>(const Row&, const Row&) = default;
  [[nodiscard]] bool same_triangle(const Row& o) const {
    return low == o.low && mid == o.mid && high == o.high && side == o.side;
  }
  [[nodiscard]] Triangle triangle() const {
    return side == 0 ? Triangle{low, mid, high} : Triangle{low, high, mid};
  }
};

Row make_row(const Triangle& t, std::uint32_t face) {
  Triangle r = t;
  if (r[1] < r[0] && r[1] < r[2])
    r = {t[1], t[2], t[0]};
  else if (r[2] < r[0] && r[2] < r[1])
    r = {t[2], t[0], t[1]};
  return r[1] < r[2] ? Row{r[0], r[1], r[2], 0, face} : Row{r[0], r[2], r[1], 1, face};
}

/// Rows of all triangles that have an area, sorted.
std::vector<Row> sorted_rows(const GridMesh& mesh, const std::vector<std::uint32_t>& renumbered,
                             const std::vector<Vec3i>& vertices, MeshFindings& findings) {
  Box3i box = empty_box<std::int32_t>();
  for (const Vec3i& v : vertices) box.include(v);
  bool narrow = true;  // differences below 2^30: 64-bit products suffice
  for (int k = 0; k < 3; ++k)
    narrow = narrow && (vertices.empty() || std::int64_t{box.hi[k]} - box.lo[k] < (1 << 30));

  std::vector<std::uint32_t> first(vertices.size() + 1, 0);
  std::vector<Row> unsorted;
  unsorted.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const Triangle w{renumbered[t[0]], renumbered[t[1]], renumbered[t[2]]};
    const Vec3i &a = vertices[w[0]], &b = vertices[w[1]], &c = vertices[w[2]];
    const bool flat = w[0] == w[1] || w[1] == w[2] || w[2] == w[0] ||
                      (narrow ? collinear<std::int64_t>(a, b, c) : collinear<__int128>(a, b, c));
    if (flat) {
      ++findings.degenerate_triangles;
      continue;
    }
    unsorted.push_back(make_row(w, mesh.faces.empty() ? kNoFace : mesh.faces[i]));
    ++first[unsorted.back().low + 1];
  }
  // Buckets by lowest vertex hold a handful of triangles each: linear overall.
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<Row> rows(unsorted.size());
  std::vector<std::uint32_t> next(first.begin(), first.end() - (first.empty() ? 0 : 1));
  for (const Row& row : unsorted) rows[next[row.low]++] = row;
  for (std::size_t v = 0; v + 1 < first.size(); ++v)
    if (first[v + 1] - first[v] > 1)
      std::sort(rows.begin() + first[v], rows.begin() + first[v + 1]);
  return rows;
}

std::uint64_t unbalanced_edges(std::size_t vertices, const std::vector<Row>& rows) {
  std::vector<Triangle> triangles;
  triangles.reserve(rows.size());
  for (const Row& row : rows) triangles.push_back(row.triangle());
  const Topology topology = make_topology(vertices, triangles);
  std::uint64_t count = 0;
  for (std::size_t e = 0; e + 1 < topology.edges.size(); ++e) {
    int net = 0;
    for (const std::uint32_t t : topology.triangles_of(e)) net += topology.sense(e, triangles[t]);
    count += net != 0 ? 1U : 0U;
  }
  return count;
}

/// Drops repetitions unless the balance of the edges needs them: two nested solids that share a
/// face list its triangles twice with reason.
void drop_duplicates(std::size_t vertices, std::vector<Row>& rows, MeshFindings& findings) {
  const auto same = [](const Row& a, const Row& b) { return a.same_triangle(b); };
  if (std::adjacent_find(rows.begin(), rows.end(), same) == rows.end()) return;
  std::vector<Row> once = rows;
  once.erase(std::unique(once.begin(), once.end(), same), once.end());
  if (unbalanced_edges(vertices, once) > unbalanced_edges(vertices, rows)) return;
  findings.duplicate_triangles += rows.size() - once.size();
  rows = std::move(once);
}

}  // namespace

void drop_unused_vertices(GridMesh& mesh) {
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) renumbered[v] = 1;
  std::uint32_t used = 0;
  for (std::size_t v = 0; v < renumbered.size(); ++v) {
    if (renumbered[v] == 0) continue;
    mesh.vertices[used] = mesh.vertices[v];
    renumbered[v] = used++;
  }
  if (used == mesh.vertices.size()) return;
  mesh.vertices.resize(used);
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = renumbered[v];
}

GridMesh weld(const GridMesh& mesh, MeshFindings& findings) {
  GridMesh welded;
  const std::vector<std::uint32_t> renumbered = weld_vertices(mesh.vertices, welded.vertices);
  std::vector<Row> rows = sorted_rows(mesh, renumbered, welded.vertices, findings);
  drop_duplicates(welded.vertices.size(), rows, findings);
  welded.triangles.reserve(rows.size());
  for (const Row& row : rows) welded.triangles.push_back(row.triangle());
  if (!mesh.faces.empty()) {
    welded.faces.reserve(rows.size());
    for (const Row& row : rows) welded.faces.push_back(row.face);
  }
  drop_unused_vertices(welded);
  return welded;
}

}  // namespace strake::geometry
