// SPDX-License-Identifier: Apache-2.0
#include "io/mesh/mesh_building.hpp"

#include <algorithm>
#include <vector>

#include "strake/geometry/triangulate.hpp"

namespace strake::io {
namespace {

/// Handles the usual case: the vertices of an object lie together, so a table over their range is
/// small.
std::vector<std::uint32_t> compact_by_table(std::vector<std::uint32_t>& indices, std::uint32_t low,
                                            std::size_t range) {
  constexpr std::uint32_t kUnused = 0xffffffffU;
  std::vector<std::uint32_t> number(range, kUnused), used;
  for (const std::uint32_t index : indices) number[index - low] = 0;
  for (std::size_t i = 0; i < range; ++i) {
    if (number[i] == kUnused) continue;
    number[i] = static_cast<std::uint32_t>(used.size());
    used.push_back(low + static_cast<std::uint32_t>(i));
  }
  for (std::uint32_t& index : indices) index = number[index - low];
  return used;
}

}  // namespace

std::vector<std::uint32_t> renumber_indices(std::vector<std::uint32_t>& indices) {
  if (indices.empty()) return {};
  const auto [least, largest] = std::minmax_element(indices.begin(), indices.end());
  const std::uint32_t low = *least;
  const std::size_t range = std::size_t{*largest} - low + 1;
  if (range / 4 <= indices.size()) return compact_by_table(indices, low, range);
  std::vector<std::uint32_t> used = indices;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::uint32_t& index : indices)
    index = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), index) -
                                       used.begin());
  return used;
}

namespace {

using geometry::Vec3d;

/// Whether a quadrilateral is cut by either diagonal into two triangles of one sense: so are most
/// polygons of real files, which are not worth a triangulation.
bool is_convex_quad(const geometry::TriangleMesh& mesh, std::span<const std::uint32_t> corners) {
  if (corners.size() != 4) return false;
  const Vec3d &a = mesh.vertices[corners[0]], &b = mesh.vertices[corners[1]],
              &c = mesh.vertices[corners[2]], &d = mesh.vertices[corners[3]];
  const Vec3d abc = cross(b - a, c - a), acd = cross(c - a, d - a);
  const Vec3d bcd = cross(c - b, d - b), bda = cross(d - b, a - b);
  return dot(abc, acd) > 0 && dot(bcd, bda) > 0 && dot(abc, bcd) > 0;
}

void append_fan(geometry::TriangleMesh& mesh, std::span<const std::uint32_t> corners) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

}  // namespace

bool append_polygon(geometry::TriangleMesh& mesh, std::span<const std::uint32_t> corners) {
  if (corners.size() == 3 || is_convex_quad(mesh, corners)) {
    append_fan(mesh, corners);
    return true;
  }
  std::vector<Vec3d> contour;
  contour.reserve(corners.size());
  for (const std::uint32_t corner : corners) contour.push_back(mesh.vertices[corner]);
  const geometry::FaceTriangles face = geometry::triangulate_face(contour);
  if (face.fault != geometry::FaceFault::none) {
    append_fan(mesh, corners);
    return false;
  }
  for (const geometry::Triangle& t : face.triangles)
    mesh.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
  return true;
}

}  // namespace strake::io
