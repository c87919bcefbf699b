// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <tuple>
#include <variant>
#include <vector>

#include "core/parting.hpp"
#include "geometry/bvh/parallel_traversal.hpp"
#include "geometry/interior_depth/bounds/convexity.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"
#include "geometry/obb/oriented_box.hpp"
#include "strake/geometry/depth.hpp"
#include "strake/geometry/predicates.hpp"
#include "strake/parallel/find.hpp"
#include "strake/parallel/for_each.hpp"

namespace strake::geometry {
namespace {

/// Maximum number of planes kept for a part that is not convex: its hull is only a bound.
constexpr std::size_t kMaxHullPlanes = 48;
constexpr std::size_t kMaxConvexPlanes = 1024;
/// How far, in grid units, a neighbour may stand above a face of a part called nearly convex:
/// snapping moves a vertex by less than one, and a face's short side magnifies that.
constexpr double kConvexSlack = 4;

/// Number of flat faces sought among the slivers of a part with more faces than are kept. With them
/// the planes of a rotated fan cost a fifth of what one plane for each sliver cost.
constexpr int kNeedleFaces = 16;

/// Beyond this many triangles coplanar faces are found by their hashes: sorting would cost more.
/// Between 128 and 2048 ships show no difference (decision 0073).
constexpr std::size_t kSorted = 512;

struct DistinctFace {
  std::array<std::int64_t, 3> key{};  ///< the normal in steps of 2^-40: equal for coplanar faces
  Vec3d normal;
  double area = 0;  ///< twice
  double tilt = 0;  ///< angle error of a sliver by the snap; otherwise 0

  /// Of length 0 for no face.
  explicit DistinctFace(const Vec3d& n) : area(length(n)) {
    if (!(area > 0)) return;
    normal = {n.x / area, n.y / area, n.z / area};
    for (int k = 0; k < 3; ++k) {
      const double steps = normal[k] * 0x1p40;
      key[static_cast<std::size_t>(k)] =
          static_cast<std::int64_t>(steps + (steps < 0 ? -0.5 : 0.5));
    }
  }
  DistinctFace() = default;
};

DistinctFace face_of(const Part& part, std::uint32_t t) {
  const Corners c = corners_of(part, t);
  const Vec3d n = normal_of(c);
  DistinctFace face(n);
  if (const double tilt = snap_angle_error(c, n); tilt > kSliverAngle) face.tilt = tilt;
  return face;
}

std::vector<DistinctFace> all_faces(const Part& part, const parallel::Context& context) {
  std::vector<DistinctFace> faces(part.triangles.size());
  const Status done = parallel::for_each(
      context, over_part("face normals", faces.size()),
      [&](std::size_t t) { faces[t] = face_of(part, static_cast<std::uint32_t>(t)); });
  if (!done) return {};
  std::erase_if(faces, [](const DistinctFace& face) { return !(face.area > 0); });
  return faces;
}

/// Makes one face of those with one key, in order of first appearance.
void merge_by_hash(std::vector<DistinctFace>& faces) {
  constexpr std::uint32_t kFree = 0xffffffffU;
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * faces.size() + 1), kFree);
  const std::size_t mask = slots.size() - 1;
  std::size_t kept = 0;
  for (const DistinctFace& face : faces) {
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

void merge_by_sorting(std::vector<DistinctFace>& faces) {
  std::sort(faces.begin(), faces.end(), [](const DistinctFace& a, const DistinctFace& b) {
    return std::tie(a.key, b.area, a.normal, a.tilt) < std::tie(b.key, a.area, b.normal, b.tilt);
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

/// Merges the slivers that differ from the largest one by no more than the angle errors of the snap
/// into one face with their mean normal. False where these are few.
bool merge_needles_of_largest(std::vector<DistinctFace>& faces) {
  const auto less = [](const DistinctFace& x, const DistinctFace& y) {
    const double of_x = x.tilt > 0 ? x.area : 0, of_y = y.tilt > 0 ? y.area : 0;
    return of_x != of_y ? of_x < of_y : x.key > y.key;
  };
  const DistinctFace seed = *std::ranges::max_element(faces, less);
  if (!(seed.tilt > 0)) return false;
  const auto is_like = [&](const DistinctFace& face) {
    return face.tilt > 0 && may_be_one_face(face.normal, face.tilt, seed.normal, seed.tilt);
  };
  if (static_cast<std::size_t>(std::ranges::count_if(faces, is_like)) < kFewestSlivers)
    return false;
  Vec3d sum;
  for (const DistinctFace& face : faces)
    if (is_like(face)) sum = sum + face.normal * face.area;
  std::erase_if(faces, is_like);
  faces.emplace_back(sum);
  return true;
}

void keep_largest(std::vector<DistinctFace>& faces, std::size_t limit) {
  if (faces.size() <= limit) return;
  part_at(std::span(faces), limit, [](const DistinctFace& a, const DistinctFace& b) {
    return a.area != b.area ? a.area > b.area : a.key < b.key;
  });
  faces.resize(limit);
}

/// The distinct faces, at most `limit`, by normal.
std::vector<DistinctFace> distinct_faces(const Part& part, std::size_t limit,
                                         const parallel::Context& context) {
  std::vector<DistinctFace> faces = all_faces(part, context);
  if (faces.size() > kSorted)
    merge_by_hash(faces);
  else
    merge_by_sorting(faces);
  for (int i = 0; i < kNeedleFaces && faces.size() > kMaxConvexPlanes; ++i)
    if (!merge_needles_of_largest(faces)) break;
  keep_largest(faces, limit);
  std::sort(faces.begin(), faces.end(),
            [](const DistinctFace& a, const DistinctFace& b) { return a.key < b.key; });
  return faces;
}

std::uint32_t apex(const Triangle& t, const PartEdge& edge) {
  for (const std::uint32_t v : t)
    if (v != edge.v0 && v != edge.v1) return v;
  return t[0];
}

/// Whether a test holds for every edge with its first two triangles, and all have two.
template <class Test>
bool holds_at_all_edges(const Part& part, const parallel::Context& context, const Test& test) {
  if (part.kind != PartKind::solid || part.edges.empty()) return false;
  const auto holds = parallel::all_of(
      context, over_part("convex edges", part.edges.size() - 1), [&](std::size_t e) {
        const std::uint32_t first = part.edges[e].first_triangle;
        return part.edges[e + 1].first_triangle - first == 2 &&
               test(part.edges[e], part.edge_triangles[first], part.edge_triangles[first + 1]);
      });
  return holds && *holds;
}

/// No neighbour stands more than the slack above a face, over all edges.
bool convex_edges(const Part& part, double slack, const parallel::Context& context) {
  return holds_at_all_edges(
      part, context, [&](const PartEdge& edge, std::uint32_t t, std::uint32_t u) {
        const Vec3d n = normal_of(corners_of(part, t));
        const Vec3d base = part.vertices[edge.v0].as<double>();
        const Vec3d tip = part.vertices[apex(part.triangles[u], edge)].as<double>();
        const double above = dot(n, tip - base);
        return !(above > 0 && above > slack * length(n));
      });
}

/// The same without any slack.
bool exactly_convex_edges(const Part& part, const parallel::Context& context) {
  const auto corner = [&](std::uint32_t v) { return part.vertices[v].as<std::int64_t>(); };
  return holds_at_all_edges(part, context,
                            [&](const PartEdge& edge, std::uint32_t t, std::uint32_t u) {
                              const Triangle& base = part.triangles[t];
                              return orient3d(corner(base[0]), corner(base[1]), corner(base[2]),
                                              corner(apex(part.triangles[u], edge))) <= 0;
                            });
}

/// No vertex stands above the plane of a face. Also false where that takes long to see: a finely
/// tessellated round body has thousands of vertices just below each of its faces.
bool below_its_faces(const Part& part, double slack) {
  constexpr std::size_t kMaxScanned = 64;  // vertices that are tested one by one
  // Without a limit two spheres of a million triangles took 24 s here. With 256 boxes a face fine
  // spheres took 1.6 µs a triangle in all, most of it here.
  constexpr std::uint64_t kFirstBoxes = 4096, kBoxesPerFace = 64;
  const bool linear = part.vertices.size() <= kMaxScanned;
  const SupportTree tree = linear ? SupportTree() : SupportTree(part.vertices);
  std::uint64_t boxes = kFirstBoxes;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
    const Vec3d n = normal_of(corners_of(part, t));
    const double base = dot(n, part.vertices[part.triangles[t][0]].as<double>());
    const double level = base + slack * length(n);
    boxes += kBoxesPerFace;
    const bool below =
        linear ? std::ranges::none_of(
                     part.vertices, [&](const Vec3i& v) { return dot(n, v.as<double>()) > level; })
               : tree.all_at_or_below(n, level, boxes);
    if (!below) return false;
  }
  return true;
}

/// Whether a kind is convex under any placement, whatever its dimensions.
bool of_convex_kind(const Primitive& primitive) {
  return std::holds_alternative<BoxPrimitive>(primitive) ||
         std::holds_alternative<CylinderPrimitive>(primitive) ||
         std::holds_alternative<SpherePrimitive>(primitive) ||
         std::holds_alternative<EllipticalDishPrimitive>(primitive) ||
         std::holds_alternative<SphericalDishPrimitive>(primitive);
}

/// Returns the rounding error of a support.
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

bool nearly_convex(const Part& part, double slack, const parallel::Context& context) {
  constexpr std::size_t kSmall = 16;  // vertices: looking at all is as fast
  if (part.kind != PartKind::solid) return false;
  if (part.primitive && of_convex_kind(*part.primitive)) return true;
  if (part.vertices.size() <= kSmall) return below_its_faces(part, slack);
  if (!convex_edges(part, slack, context)) return false;
  // A closed connected surface that is convex at every edge bounds a convex body (Tietze, Nakajima:
  // what is convex round each of its points is convex).
  return (part.shell_count == 1 && exactly_convex_edges(part, context)) ||
         below_its_faces(part, slack);
}

FaceKdop make_face_kdop(const Part& part, const parallel::Context& context) {
  FaceKdop result;
  result.nearly_convex = convex_edges(part, kConvexSlack, context);
  result.vertices = SupportTree(part.vertices, context);
  result.axes = orthonormal_axes(part);
  const double rounding = rounding_of(part);
  const auto support = [&](const Vec3d& n) {
    return result.vertices.support_along(n).value + rounding;
  };
  const std::vector<DistinctFace> faces =
      distinct_faces(part, result.nearly_convex ? kMaxConvexPlanes : kMaxHullPlanes, context);
  result.planes.reserve(faces.size());
  for (const DistinctFace& face : faces)
    result.planes.push_back({face.normal, support(face.normal)});
  for (std::size_t i = 0; i < 4; ++i) result.tetrahedral[i] = support(tetrahedral_directions()[i]);
  return result;
}

namespace {

/// The widest gap along the normals of `from`; `shift` takes `to` into its coordinates.
double widest_gap(const FaceKdop& from, const SupportTree& to, const Vec3d& shift,
                  double rounding) {
  double widest = -std::numeric_limits<double>::infinity();
  if (to.empty()) return widest;
  // The vertex that came nearest last: it settles most normals.
  Vec3d vertex = to.support_along({0, 0, 1}).vertex.as<double>();
  for (const FaceKdop::Plane& plane : from.planes) {
    const double base = dot(plane.normal, shift) - plane.support;
    // Normals are unit vectors but for rounding.
    const auto certain = [&](double least) { return (least + base) * (1 - 1e-14) - rounding; };
    if (certain(dot(plane.normal, vertex)) <= widest) continue;
    const SupportTree::SupportPoint nearest = to.support_along(-plane.normal);
    vertex = nearest.vertex.as<double>();
    widest = std::max(widest, certain(-nearest.value));
  }
  return widest;
}

}  // namespace

double kdop_separation(const DepthOperand& a, const DepthOperand& b) {
  const Part &x = *a.treed.placed.part, &y = *b.treed.placed.part;
  const Vec3d shift = (b.treed.placed.origin - a.treed.placed.origin).as<double>();
  double reach = std::fabs(shift.x) + std::fabs(shift.y) + std::fabs(shift.z);
  for (const Part* part : {&x, &y})
    for (int k = 0; k < 3; ++k)
      reach += std::fabs(static_cast<double>(part->box.lo[k])) +
               std::fabs(static_cast<double>(part->box.hi[k]));
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * reach;
  return std::max(widest_gap(*a.planes, b.planes->vertices, shift, rounding),
                  widest_gap(*b.planes, a.planes->vertices, -shift, rounding));
}

}  // namespace strake::geometry
