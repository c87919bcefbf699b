// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_repair/weld.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/mesh_repair/t_junctions.hpp"
#include "geometry/mesh_repair/tolerance_weld.hpp"
#include "geometry/mesh_repair/topology.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/predicates/exact_normal.hpp"

namespace strake::geometry {
namespace {

constexpr std::uint32_t ordered(std::int32_t value) {
  return static_cast<std::uint32_t>(value) ^ 0x80000000U;
}

std::uint64_t extent(const Box3i& box, int axis) {
  return static_cast<std::uint64_t>(std::int64_t{box.hi[axis]} - box.lo[axis]);
}

/// Where the fields of a vertex lie in a word that sorts like (x, y, z, index).
struct Packing {
  Vec3i lo;
  int y_bits = 0, z_bits = 0, index_bits = 0;
  bool fits = false;

  Packing(const Box3i& box, std::size_t count)
      : lo(box.lo),
        y_bits(static_cast<int>(std::bit_width(extent(box, 1)))),
        z_bits(static_cast<int>(std::bit_width(extent(box, 2)))),
        index_bits(static_cast<int>(std::bit_width(count))),
        fits(static_cast<int>(std::bit_width(extent(box, 0))) + y_bits + z_bits + index_bits <=
             64) {}

  [[nodiscard]] std::uint64_t pack(const Vec3i& v, std::size_t index) const {
    const auto field = [&](int axis) {
      return static_cast<std::uint64_t>(std::int64_t{v[axis]} - lo[axis]);
    };
    return ((((field(0) << y_bits) | field(1)) << z_bits | field(2)) << index_bits) | index;
  }
  [[nodiscard]] std::uint32_t index(std::uint64_t word) const {
    return static_cast<std::uint32_t>(word & ((std::uint64_t{1} << index_bits) - 1));
  }
};

/// Gives equal neighbours of a sorted order one number: `index_of(i)` is the i-th vertex in order.
template <class IndexOf>
void number_in_order(std::span<const Vec3i> vertices, std::span<std::uint32_t> renumbered,
                     std::vector<Vec3i>& welded, IndexOf&& index_of) {
  welded.resize(vertices.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::uint32_t old = index_of(i);
    if (count == 0 || welded[count - 1] != vertices[old]) welded[count++] = vertices[old];
    renumbered[old] = static_cast<std::uint32_t>(count - 1);
  }
  welded.resize(count);
}

/// Fills `welded`; returns the new index of every old vertex.
std::span<const std::uint32_t> number_vertices(const std::vector<Vec3i>& vertices, const Box3i& box,
                                               WeldScratch& scratch, std::vector<Vec3i>& welded) {
  const std::span<std::uint32_t> renumbered = first_n(scratch.renumbered, vertices.size());
  if (vertices.empty()) {
    welded.clear();
    return renumbered;
  }
  // Most meshes are small enough for a vertex to sort as one word.
  const Packing packing(box, vertices.size());
  if (packing.fits) {
    const std::span<std::uint64_t> keys = first_n(scratch.packed_keys, vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) keys[i] = packing.pack(vertices[i], i);
    std::sort(keys.begin(), keys.end());
    number_in_order(vertices, renumbered, welded,
                    [&](std::size_t i) { return packing.index(keys[i]); });
    return renumbered;
  }
  const std::span<VertexKey> keys = first_n(scratch.keys, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3i& v = vertices[i];
    keys[i] = {(std::uint64_t{ordered(v.x)} << 32U) | ordered(v.y), ordered(v.z),
               static_cast<std::uint32_t>(i)};
  }
  std::sort(keys.begin(), keys.end(), [](const VertexKey& a, const VertexKey& b) {
    return a.xy != b.xy ? a.xy < b.xy : a.z < b.z;
  });
  number_in_order(vertices, renumbered, welded, [&](std::size_t i) { return keys[i].index; });
  return renumbered;
}

/// The triangles of a mesh that have an area, in buckets by their lowest vertex.
struct Rows {
  std::span<const std::uint32_t> first;
  std::span<TriangleKey> rows;
  bool repeated = false;  ///< some triangle comes twice

  [[nodiscard]] std::size_t buckets() const { return first.size() - 1; }
  [[nodiscard]] std::span<TriangleKey> bucket(std::size_t low) const {
    return rows.subspan(first[low], first[low + 1] - first[low]);
  }
};

bool same_triangle(const TriangleKey& a, const TriangleKey& b) {
  return a.mid_high == b.mid_high && a.side == b.side;
}

Triangle triangle(std::size_t low, const TriangleKey& row) {
  const auto v = static_cast<std::uint32_t>(low);
  const auto mid = static_cast<std::uint32_t>(row.mid_high >> 32U);
  const auto high = static_cast<std::uint32_t>(row.mid_high);
  return row.side == 0 ? Triangle{v, mid, high} : Triangle{v, high, mid};
}

/// Fills scratch.unsorted and scratch.lows with the triangles that have an area; returns their
/// number and counts them in first[lowest vertex + 1].
template <class Wide>
std::size_t list_rows(const GridMesh& mesh, std::span<const std::uint32_t> renumbered,
                      std::span<const Vec3i> vertices, std::span<std::uint32_t> first,
                      WeldScratch& scratch) {
  const std::span<TriangleKey> unsorted = first_n(scratch.unsorted, mesh.triangles.size());
  const std::span<std::uint32_t> lows = first_n(scratch.lows, mesh.triangles.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const std::uint32_t a = renumbered[t[0]], b = renumbered[t[1]], c = renumbered[t[2]];
    if (collinear<Wide>(vertices[a], vertices[b], vertices[c])) continue;
    const std::uint32_t low = std::min({a, b, c}), high = std::max({a, b, c});
    const std::uint32_t mid = a ^ b ^ c ^ low ^ high;
    // Rotating a triangle's corners keeps its side: it runs low, mid, high when one of its steps is
    // from mid to high.
    const bool along =
        (a == mid && b == high) || (b == mid && c == high) || (c == mid && a == high);
    unsorted[count] = {(std::uint64_t{mid} << 32U) | high, along ? 0U : 1U,
                       mesh.faces.empty() ? kNoIndex : mesh.faces[i]};
    lows[count++] = low;
    ++first[low + 1];
  }
  return count;
}

/// Sorts a bucket, most of which hold a handful; true when a triangle comes twice.
bool sort_bucket(std::span<TriangleKey> bucket) {
  if (bucket.size() > 32) {
    std::sort(bucket.begin(), bucket.end());
  } else {
    for (std::size_t i = 1; i < bucket.size(); ++i) {
      const TriangleKey moved = bucket[i];
      std::size_t k = i;
      for (; k > 0 && moved < bucket[k - 1]; --k) bucket[k] = bucket[k - 1];
      bucket[k] = moved;
    }
  }
  return std::adjacent_find(bucket.begin(), bucket.end(), same_triangle) != bucket.end();
}

Rows sorted_rows(const GridMesh& mesh, std::span<const std::uint32_t> renumbered,
                 std::span<const Vec3i> vertices, const Box3i& box, WeldScratch& scratch) {
  const bool narrow = vertices.empty() || is_narrow(box);
  const std::span<std::uint32_t> first = first_n(scratch.first, vertices.size() + 1);
  std::fill(first.begin(), first.end(), 0U);
  const std::size_t count =
      narrow ? list_rows<std::int64_t>(mesh, renumbered, vertices, first, scratch)
             : list_rows<__int128>(mesh, renumbered, vertices, first, scratch);
  // Buckets by lowest vertex hold a handful of triangles each: linear overall.
  const std::span<std::uint32_t> next = first_n(scratch.next, vertices.size() + 1);
  next[0] = 0;
  for (std::size_t v = 1; v < first.size(); ++v) next[v] = first[v] += first[v - 1];
  const std::span<TriangleKey> rows = first_n(scratch.rows, count);
  for (std::size_t i = 0; i < count; ++i) rows[next[scratch.lows[i]]++] = scratch.unsorted[i];
  Rows sorted{first, rows, false};
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (first[v + 1] - first[v] > 1) sorted.repeated |= sort_bucket(sorted.bucket(v));
  return sorted;
}

/// Sets the triangles and faces of a mesh.
void set_triangles(const Rows& rows, bool with_faces, GridMesh& mesh) {
  mesh.triangles.clear();
  mesh.faces.clear();
  for (std::size_t low = 0; low < rows.buckets(); ++low)
    for (const TriangleKey& row : rows.bucket(low)) {
      mesh.triangles.push_back(triangle(low, row));
      if (with_faces) mesh.faces.push_back(row.face);
    }
}

Topology topology_of(RepairScratch& scratch) {
  const GridMesh& mesh = scratch.welded;
  return make_topology(mesh.vertices.size(), mesh.triangles, scratch.topology);
}

std::uint64_t unbalanced_edges(const GridMesh& mesh, const Topology& topology) {
  return open_edges(mesh.triangles, topology).size();
}

/// Drops repetitions unless the balance of the edges needs them: two nested solids that share a
/// face list its triangles twice with reason.
Topology drop_duplicates(const Topology& repeated, RepairScratch& scratch, RepairCounts& findings) {
  GridMesh& mesh = scratch.welded;
  const std::uint64_t unbalanced = unbalanced_edges(mesh, repeated);
  std::vector<Triangle> all;
  std::vector<std::uint32_t> faces;
  all.swap(mesh.triangles);
  faces.swap(mesh.faces);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0 && all[i] == all[i - 1]) continue;
    mesh.triangles.push_back(all[i]);
    if (!faces.empty()) mesh.faces.push_back(faces[i]);
  }
  const Topology once = topology_of(scratch);
  if (unbalanced_edges(mesh, once) <= unbalanced) {
    findings.duplicate_triangles += all.size() - mesh.triangles.size();
    return once;
  }
  all.swap(mesh.triangles);
  faces.swap(mesh.faces);
  return topology_of(scratch);
}

/// Drops vertices that no triangle uses, keeping the order of the others.
void drop_unused_vertices(GridMesh& mesh, std::vector<std::uint32_t>& memory) {
  const std::span<std::uint32_t> renumbered = first_n(memory, mesh.vertices.size());
  std::fill(renumbered.begin(), renumbered.end(), 0U);
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

void close_within(std::int64_t within, Closing closing, Topology& topology, RepairScratch& scratch,
                  RepairCounts& findings) {
  const std::optional<ToleranceWeld> near =
      weld_within_tolerance(within, closing, topology, scratch);
  if (!near) return;
  findings.welded_corners += near->corners;
  findings.welded_shells += near->shells;
  findings.largest_weld += near->largest;
  drop_unused_vertices(scratch.welded, scratch.weld.next);
  topology = topology_of(scratch);
  if (near->repeated) topology = drop_duplicates(topology, scratch, findings);
}

/// At a large distance vertices may cluster along fine borders. Where that leaves something open,
/// shells that close within a small distance are closed first. The sum of all displacements bounds
/// that of any vertex.
void close_seams(const Seams& seams, Topology& topology, RepairScratch& scratch,
                 RepairCounts& findings) {
  const bool wide = seams.first < seams.within;
  if (wide && unbalanced_edges(scratch.welded, topology) == 0) return;
  const GridMesh before = wide ? scratch.welded : GridMesh{};
  const RepairCounts found = findings;
  if (seams.within > 0) close_within(seams.within, Closing::all, topology, scratch, findings);
  if (!wide || unbalanced_edges(scratch.welded, topology) == 0) return;
  scratch.welded = before;
  findings = found;
  topology = topology_of(scratch);
  for (std::int64_t within = std::max<std::int64_t>(seams.first, 1); within < seams.within;
       within *= 2)
    close_within(within, Closing::whole_shells, topology, scratch, findings);
  close_within(seams.within, Closing::all, topology, scratch, findings);
}

}  // namespace

std::span<const std::uint32_t> weld_vertices(const GridMesh& mesh, RepairScratch& scratch) {
  scratch.box = box_of(mesh.vertices);
  return number_vertices(mesh.vertices, scratch.box, scratch.weld, scratch.welded.vertices);
}

bool replace_triangles(const GridMesh& mesh, std::span<const std::uint32_t> vertices,
                       RepairScratch& scratch) {
  const Rows rows = sorted_rows(mesh, vertices, scratch.welded.vertices, scratch.box, scratch.weld);
  set_triangles(rows, !mesh.faces.empty(), scratch.welded);
  return rows.repeated;
}

Topology weld_triangles(const GridMesh& mesh, std::span<const std::uint32_t> renumbered,
                        const Seams& seams, RepairScratch& scratch, RepairCounts& findings) {
  GridMesh& welded = scratch.welded;
  const Rows rows = sorted_rows(mesh, renumbered, welded.vertices, scratch.box, scratch.weld);
  findings.degenerate_triangles += mesh.triangles.size() - rows.rows.size();
  bool repeated = rows.repeated;
  set_triangles(rows, !mesh.faces.empty(), welded);
  drop_unused_vertices(welded, scratch.weld.next);
  Topology topology = topology_of(scratch);
  if (std::optional<CutMesh> cut = split_at_t_junctions(welded, topology)) {
    findings.cut_triangles += cut->cut;
    std::vector<std::uint32_t> same(welded.vertices.size());
    std::iota(same.begin(), same.end(), 0U);
    repeated =
        replace_triangles({{}, std::move(cut->triangles), std::move(cut->faces)}, same, scratch);
    topology = topology_of(scratch);
  }
  if (repeated) topology = drop_duplicates(topology, scratch, findings);
  close_seams(seams, topology, scratch, findings);
  if (const std::uint64_t turned = orient_consistently(welded, topology)) {
    findings.turned_triangles += turned;
    topology = topology_of(scratch);
  }
  return topology;
}

}  // namespace strake::geometry
