// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "geometry/depth/nearest.hpp"
#include "strake/geometry/depth.hpp"

namespace strake::geometry {
namespace {

/// Planes kept of a part that is not convex: its hull is only a bound there.
constexpr std::size_t kMaxHullPlanes = 48;
constexpr std::size_t kMaxConvexPlanes = 1024;
/// How far, in grid units, a neighbour may stand above a face of a part called nearly convex:
/// snapping moves a vertex by less than one, and a face's short side magnifies that.
constexpr double kConvexSlack = 4;

struct Face {
  std::array<std::int64_t, 3> key{};  ///< the normal in steps of 2^-40: equal for coplanar faces
  Vec3d normal;
  double area = 0;
};

Face face_of(const Part& part, std::uint32_t t) {
  const Corners c = corners_of(part, t);
  const Vec3d n = cross(c[1] - c[0], c[2] - c[0]);
  Face face;
  face.area = length(n);
  if (!(face.area > 0)) return face;
  face.normal = {n.x / face.area, n.y / face.area, n.z / face.area};
  for (int k = 0; k < 3; ++k)
    face.key[static_cast<std::size_t>(k)] = std::llround(face.normal[k] * 0x1p40);
  return face;
}

std::vector<Face> distinct_faces(const Part& part) {
  std::vector<Face> faces;
  faces.reserve(part.triangles.size());
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
    const Face face = face_of(part, t);
    if (face.area > 0) faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return a.key != b.key ? a.key < b.key : a.area > b.area;
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (kept > 0 && faces[kept - 1].key == faces[i].key)
      faces[kept - 1].area += faces[i].area;
    else
      faces[kept++] = faces[i];
  }
  faces.resize(kept);
  return faces;
}

void keep_largest(std::vector<Face>& faces, std::size_t most) {
  if (faces.size() <= most) return;
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return a.area != b.area ? a.area > b.area : a.key < b.key;
  });
  faces.resize(most);
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.key < b.key; });
}

std::uint32_t apex(const Triangle& t, const PartEdge& edge) {
  for (const std::uint32_t v : t)
    if (v != edge.v0 && v != edge.v1) return v;
  return t[0];
}

/// No neighbour stands above a face, over all edges; false at the first that does.
bool convex_edges(const Part& part) {
  if (part.kind != PartKind::solid || part.edges.empty()) return false;
  for (std::size_t e = 0; e + 1 < part.edges.size(); ++e) {
    const std::uint32_t first = part.edges[e].first_triangle;
    if (part.edges[e + 1].first_triangle - first != 2) return false;
    const std::uint32_t t = part.edge_triangles[first], u = part.edge_triangles[first + 1];
    const Face face = face_of(part, t);
    const Vec3d base = part.vertices[part.edges[e].v0].as<double>();
    const Vec3d tip = part.vertices[apex(part.triangles[u], part.edges[e])].as<double>();
    if (dot(face.normal, tip - base) > kConvexSlack) return false;
  }
  return true;
}

double support(const Part& part, const Vec3d& n) {
  double best = -std::numeric_limits<double>::infinity();
  for (const Vec3i& v : part.vertices) {
    const double h = n.x * static_cast<double>(v.x) + n.y * static_cast<double>(v.y) +
                     n.z * static_cast<double>(v.z);
    best = std::max(best, h);
  }
  double reach = 0;
  for (int k = 0; k < 3; ++k)
    reach = std::max({reach, std::fabs(static_cast<double>(part.box.lo[k])),
                      std::fabs(static_cast<double>(part.box.hi[k]))});
  return best + 8 * std::numeric_limits<double>::epsilon() * reach;
}

}  // namespace

const std::array<Vec3d, 4>& tetrahedral_directions() {
  // (±1, ±1, ±1)/√3 with an even number of minus signs.
  static constexpr double kPart = 0.57735026918962576;
  static constexpr std::array<Vec3d, 4> kDirections{
      Vec3d{kPart, kPart, kPart}, Vec3d{kPart, -kPart, -kPart}, Vec3d{-kPart, kPart, -kPart},
      Vec3d{-kPart, -kPart, kPart}};
  return kDirections;
}

SupportPlanes make_support_planes(const Part& part) {
  SupportPlanes result;
  result.nearly_convex = convex_edges(part);
  std::vector<Face> faces = distinct_faces(part);
  keep_largest(faces, result.nearly_convex ? kMaxConvexPlanes : kMaxHullPlanes);
  result.planes.reserve(faces.size());
  for (const Face& face : faces) result.planes.push_back({face.normal, support(part, face.normal)});
  for (std::size_t i = 0; i < 4; ++i)
    result.tetrahedral[i] = support(part, tetrahedral_directions()[i]);
  return result;
}

}  // namespace strake::geometry
