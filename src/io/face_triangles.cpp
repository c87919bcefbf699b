// SPDX-License-Identifier: Apache-2.0
#include "io/face_triangles.hpp"

#include <vector>

#include "strake/geometry/triangulate.hpp"

namespace strake::io {
namespace {

using geometry::Vec3d;

/// A quadrilateral that either diagonal cuts into two triangles of one sense: most polygons of
/// real files, and not worth a triangulation.
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

bool append_face(geometry::TriangleMesh& mesh, std::span<const std::uint32_t> corners) {
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
