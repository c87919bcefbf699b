// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "geometry/corners.hpp"
#include "geometry/directions.hpp"
#include "strake/geometry/depth.hpp"
#include "strake/geometry/meeting_places.hpp"
#include "strake/geometry/predicates.hpp"

namespace strake::geometry {
namespace {

/// Planes kept of a part that is not convex: its hull is only a bound there.
constexpr std::size_t kMaxHullPlanes = 48;
constexpr std::size_t kMaxConvexPlanes = 1024;
/// How far, in grid units, a neighbour may stand above a face of a part called nearly convex:
/// snapping moves a vertex by less than one, and a face's short side magnifies that.
constexpr double kConvexSlack = 4;

/// Beyond this many triangles coplanar faces are found by their hashes: sorting would cost more.
constexpr std::size_t kSorted = 512;

struct Face {
  std::array<std::int64_t, 3> key{};  ///< the normal in steps of 2^-40: equal for coplanar faces
  Vec3d normal;
  double area = 0;  ///< twice
};

Face face_of(const Part& part, std::uint32_t t) {
  const Vec3d n = normal_of(corners_of(part, t));
  Face face;
  face.area = length(n);
  if (!(face.area > 0)) return face;
  face.normal = {n.x / face.area, n.y / face.area, n.z / face.area};
  for (int k = 0; k < 3; ++k) {
    const double steps = face.normal[k] * 0x1p40;
    face.key[static_cast<std::size_t>(k)] =
        static_cast<std::int64_t>(steps + (steps < 0 ? -0.5 : 0.5));
  }
  return face;
}

std::vector<Face> all_faces(const Part& part) {
  std::vector<Face> faces;
  faces.reserve(part.triangles.size());
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
    const Face face = face_of(part, t);
    if (face.area > 0) faces.push_back(face);
  }
  return faces;
}

/// Makes one face of those with one key, in order of first appearance.
void merge_by_hash(std::vector<Face>& faces) {
  constexpr std::uint32_t kFree = 0xffffffffU;
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * faces.size() + 1), kFree);
  const std::size_t mask = slots.size() - 1;
  std::size_t kept = 0;
  for (const Face& face : faces) {
    std::uint64_t h = 0;
    for (const std::int64_t k : face.key)
      h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15ULL;
    std::size_t slot = (h ^ (h >> 32U)) & mask;
    while (slots[slot] != kFree && faces[slots[slot]].key != face.key) slot = (slot + 1) & mask;
    if (slots[slot] != kFree) {
      faces[slots[slot]].area += face.area;
    } else {
      slots[slot] = static_cast<std::uint32_t>(kept);
      faces[kept++] = face;
    }
  }
  faces.resize(kept);
}

void merge_by_sorting(std::vector<Face>& faces) {
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
}

void keep_largest(std::vector<Face>& faces, std::size_t most) {
  if (faces.size() <= most) return;
  std::nth_element(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(most), faces.end(),
                   [](const Face& a, const Face& b) {
                     return a.area != b.area ? a.area > b.area : a.key < b.key;
                   });
  faces.resize(most);
}

/// The distinct faces, at most `most`, by normal.
std::vector<Face> distinct_faces(const Part& part, std::size_t most) {
  std::vector<Face> faces = all_faces(part);
  if (faces.size() > kSorted)
    merge_by_hash(faces);
  else
    merge_by_sorting(faces);
  keep_largest(faces, most);
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.key < b.key; });
  return faces;
}

std::uint32_t apex(const Triangle& t, const PartEdge& edge) {
  for (const std::uint32_t v : t)
    if (v != edge.v0 && v != edge.v1) return v;
  return t[0];
}

/// No neighbour stands above a face, over all edges; false at the first that does.
bool convex_edges(const Part& part, double slack) {
  if (part.kind != PartKind::solid || part.edges.empty()) return false;
  for (std::size_t e = 0; e + 1 < part.edges.size(); ++e) {
    const std::uint32_t first = part.edges[e].first_triangle;
    if (part.edges[e + 1].first_triangle - first != 2) return false;
    const std::uint32_t t = part.edge_triangles[first], u = part.edge_triangles[first + 1];
    const Vec3d n = normal_of(corners_of(part, t));
    const Vec3d base = part.vertices[part.edges[e].v0].as<double>();
    const Vec3d tip = part.vertices[apex(part.triangles[u], part.edges[e])].as<double>();
    const double above = dot(n, tip - base);
    if (above > 0 && above > slack * length(n)) return false;
  }
  return true;
}

/// The same without any slack; two triangles round each edge, as convex_edges() found.
bool exactly_convex_edges(const Part& part) {
  for (std::size_t e = 0; e + 1 < part.edges.size(); ++e) {
    const std::uint32_t first = part.edges[e].first_triangle;
    const Triangle &t = part.triangles[part.edge_triangles[first]],
                   &u = part.triangles[part.edge_triangles[first + 1]];
    const auto corner = [&](std::uint32_t v) { return part.vertices[v].as<std::int64_t>(); };
    if (orient3d(corner(t[0]), corner(t[1]), corner(t[2]), corner(apex(u, part.edges[e]))) > 0)
      return false;
  }
  return true;
}

/// No vertex stands above the plane of a face. Also false where that takes long to see: a finely
/// tessellated round body has thousands of vertices just below each of its faces.
bool below_its_faces(const Part& part, double slack) {
  constexpr std::size_t kMostWalked = 64;  // vertices that are looked at one by one
  constexpr std::uint64_t kFirstBoxes = 4096, kBoxesPerFace = 64;
  const bool walk = part.vertices.size() <= kMostWalked;
  const VertexTree tree = walk ? VertexTree() : VertexTree(part.vertices);
  std::uint64_t boxes = kFirstBoxes;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
    const Vec3d n = normal_of(corners_of(part, t));
    const double base = dot(n, part.vertices[part.triangles[t][0]].as<double>());
    const double level = base + slack * length(n);
    boxes += kBoxesPerFace;
    const bool below =
        walk ? std::ranges::none_of(part.vertices,
                                    [&](const Vec3i& v) { return dot(n, v.as<double>()) > level; })
             : tree.none_above(n, level, boxes);
    if (!below) return false;
  }
  return true;
}

/// Convex however it is placed, whatever its measures.
bool of_convex_kind(const Primitive& primitive) {
  return std::holds_alternative<BoxPrimitive>(primitive) ||
         std::holds_alternative<CylinderPrimitive>(primitive) ||
         std::holds_alternative<SpherePrimitive>(primitive) ||
         std::holds_alternative<EllipticalDishPrimitive>(primitive) ||
         std::holds_alternative<SphericalDishPrimitive>(primitive);
}

/// What rounding may leave out of a support.
double rounding_of(const Part& part) {
  double reach = 0;
  for (int k = 0; k < 3; ++k)
    reach = std::max({reach, std::fabs(static_cast<double>(part.box.lo[k])),
                      std::fabs(static_cast<double>(part.box.hi[k]))});
  return 8 * std::numeric_limits<double>::epsilon() * reach;
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

bool nearly_convex(const Part& part, double slack) {
  constexpr std::size_t kSmall = 16;  // vertices: looking at all is as fast
  if (part.kind != PartKind::solid) return false;
  if (part.primitive && of_convex_kind(*part.primitive)) return true;
  if (part.vertices.size() <= kSmall) return below_its_faces(part, slack);
  if (!convex_edges(part, slack)) return false;
  // A closed connected surface that is convex at every edge bounds a convex body (Tietze, Nakajima:
  // what is convex round each of its points is convex).
  return (part.shell_count == 1 && exactly_convex_edges(part)) || below_its_faces(part, slack);
}

SupportPlanes make_support_planes(const Part& part) {
  SupportPlanes result;
  result.nearly_convex = convex_edges(part, kConvexSlack);
  result.vertices = VertexTree(part.vertices);
  const double rounding = rounding_of(part);
  const auto support = [&](const Vec3d& n) {
    return result.vertices.greatest_along(n).value + rounding;
  };
  const std::vector<Face> faces =
      distinct_faces(part, result.nearly_convex ? kMaxConvexPlanes : kMaxHullPlanes);
  result.planes.reserve(faces.size());
  for (const Face& face : faces) result.planes.push_back({face.normal, support(face.normal)});
  for (std::size_t i = 0; i < 4; ++i) result.tetrahedral[i] = support(tetrahedral_directions()[i]);
  return result;
}

}  // namespace strake::geometry
