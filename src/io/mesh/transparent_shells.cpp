// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/transparent_shells.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "core/union_find.hpp"
#include "io/mesh/mesh_building.hpp"

namespace strake::io {
namespace {

using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Vec3d;

/// An edge of a triangle, under its corners in ascending order.
struct MeshEdge {
  std::uint32_t low = 0, high = 0;
  std::uint32_t triangle = 0;  ///< the opaque ones first
  bool upwards = false;        ///< it runs from low to high

  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> key() const { return {low, high}; }
};

/// Returns a number for each vertex of the two meshes, the same where they lie in the same place.
std::vector<std::uint32_t> places(const TriangleMesh& opaque, const TriangleMesh& transparent) {
  std::vector<Vec3d> points = opaque.vertices;
  points.insert(points.end(), transparent.vertices.begin(), transparent.vertices.end());
  std::vector<std::uint32_t> order(points.size()), place(points.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  const auto coordinates = [&](std::uint32_t i) {
    return std::tie(points[i].x, points[i].y, points[i].z);
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return coordinates(a) < coordinates(b); });
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i != 0 && coordinates(order[i - 1]) != coordinates(order[i])) ++next;
    place[order[i]] = next;
  }
  return place;
}

std::vector<MeshEdge> edges_of(const TriangleMesh& opaque, const TriangleMesh& transparent) {
  const std::vector<std::uint32_t> place = places(opaque, transparent);
  std::vector<MeshEdge> edges;
  edges.reserve(3 * (opaque.triangles.size() + transparent.triangles.size()));
  std::uint32_t number = 0;
  const auto add = [&](const TriangleMesh& mesh, std::size_t base) {
    for (const Triangle& triangle : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = place[base + triangle[k]];
        const std::uint32_t to = place[base + triangle[(k + 1) % 3]];
        if (from != to)
          edges.push_back({std::min(from, to), std::max(from, to), number, from < to});
      }
      ++number;
    }
  };
  add(opaque, 0);
  add(transparent, opaque.vertices.size());
  std::sort(edges.begin(), edges.end(),
            [](const MeshEdge& a, const MeshEdge& b) { return a.key() < b.key(); });
  return edges;
}

/// What is known of shells, by the triangle that stands for each.
struct Shells {
  UnionFind joined;
  std::vector<bool> open;    ///< some edge of it does not run both ways equally often
  std::vector<bool> seamed;  ///< some edge does so only with faces of both kinds
};

Shells shells_of(const std::vector<MeshEdge>& edges, std::size_t opaque, std::size_t triangles) {
  Shells shells{UnionFind(triangles), std::vector<bool>(triangles), std::vector<bool>(triangles)};
  const auto each_bundle = [&](auto&& visit) {
    for (std::size_t begin = 0, end = 0; begin != edges.size(); begin = end) {
      while (end != edges.size() && edges[end].key() == edges[begin].key()) ++end;
      visit(begin, end);
    }
  };
  each_bundle([&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i)
      shells.joined.join(edges[begin].triangle, edges[i].triangle);
  });
  each_bundle([&](std::size_t begin, std::size_t end) {
    std::ptrdiff_t all = 0, of_opaque = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const std::ptrdiff_t way = edges[i].upwards ? 1 : -1;
      all += way;
      if (edges[i].triangle < opaque) of_opaque += way;
    }
    const std::uint32_t shell = shells.joined.root(edges[begin].triangle);
    if (all != 0) shells.open[shell] = true;
    if (all == 0 && of_opaque != 0) shells.seamed[shell] = true;
  });
  return shells;
}

void drop_unused_vertices(TriangleMesh& mesh) {
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  std::vector<Vec3d> vertices;
  for (const std::uint32_t used : renumber_indices(corners))
    vertices.push_back(mesh.vertices[used]);
  mesh.vertices = std::move(vertices);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    mesh.triangles[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
}

/// Moves the triangles for which `moves` is set from one mesh to the other.
void move_triangles(const std::vector<bool>& moves, TriangleMesh& from, TriangleMesh& to) {
  const auto base = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), from.vertices.begin(), from.vertices.end());
  const bool faces = !from.faces.empty() || !to.faces.empty();
  std::uint32_t first_face = 0;
  if (faces) {
    to.faces.resize(to.triangles.size(), geometry::kNoIndex);
    from.faces.resize(from.triangles.size(), geometry::kNoIndex);
    for (const std::uint32_t face : to.faces)
      if (face != geometry::kNoIndex) first_face = std::max(first_face, face + 1);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const Triangle t = from.triangles[i];
    const std::uint32_t face = faces ? from.faces[i] : geometry::kNoIndex;
    if (moves[i]) {
      to.triangles.push_back({base + t[0], base + t[1], base + t[2]});
      if (faces) to.faces.push_back(face == geometry::kNoIndex ? face : first_face + face);
    } else {
      from.triangles[kept] = t;
      if (faces) from.faces[kept] = face;
      ++kept;
    }
  }
  from.triangles.resize(kept);
  if (faces) from.faces.resize(kept);
  drop_unused_vertices(from);
  drop_unused_vertices(to);
}

}  // namespace

bool merge_transparent_shells(TriangleMesh& opaque, TriangleMesh& transparent) {
  if (opaque.triangles.empty() || transparent.triangles.empty()) return false;
  const std::size_t first = opaque.triangles.size(), count = transparent.triangles.size();
  Shells shells = shells_of(edges_of(opaque, transparent), first, first + count);
  std::vector<bool> moves(count);
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t shell = shells.joined.root(static_cast<std::uint32_t>(first + i));
    moves[i] = shells.seamed[shell] && !shells.open[shell];
    any = any || moves[i];
  }
  if (any) move_triangles(moves, transparent, opaque);
  return any;
}

void note_merged_shell(model::Model& model, std::string where) {
  model.diagnostics.add(Severity::note, "mesh-part-transparent",
                        "a solid has transparent faces besides opaque ones and is drawn as opaque",
                        std::move(where));
}

}  // namespace strake::io
