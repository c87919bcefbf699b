// SPDX-License-Identifier: Apache-2.0
#include "geometry/obb/rotated_part.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/numeric/morton_order.hpp"
#include "geometry/numeric/triangle_math.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::geometry {
namespace {

/// The largest rotated coordinate: they are stored in 32 bits.
constexpr double kFarthest = 2147483000;

}  // namespace

std::optional<RotatedPart> rotate_part(const PairLocalPart& view, const Axes& axes,
                                       const parallel::Context& context) {
  Part part;
  part.triangles = view.part().triangles;
  part.vertices.resize(view.part().vertices.size());
  for (std::uint32_t v = 0; v < part.vertices.size(); ++v) {
    const Vec3d at = turned(axes, view.vertex(v).as<double>());
    for (int k = 0; k < 3; ++k) {
      if (!(std::fabs(at[k]) < kFarthest)) return std::nullopt;
      part.vertices[v][k] = static_cast<std::int32_t>(std::llround(at[k]));
    }
  }
  const std::vector<std::uint32_t>& some = view.tree().order();
  TriangleBvh tree =
      some.size() == part.triangles.size() ? TriangleBvh(part, context) : TriangleBvh(part, some);
  if (tree.nodes().empty()) return std::nullopt;
  return RotatedPart{std::move(part), std::move(tree)};
}

namespace {

/// Number of triangles sampled, and how many of their edges have to be parallel.
constexpr std::size_t kSampledEdges = 32;
constexpr std::ptrdiff_t kMinAlike = 8;
/// The ratio from which on an edge is so much longer than the height over it that the triangle is a
/// sliver.
constexpr double kElongation = 3;
/// Cosine of the angle within which edges count as parallel.
constexpr double kSameDirection = 0.9999;

/// A long edge of a sliver.
struct LongEdge {
  Vec3d way, normal;   ///< units
  double squared = 0;  ///< its length
};

bool in_one_direction(const Vec3d& x, const Vec3d& y) {
  return std::fabs(dot(x, y)) >= kSameDirection;
}

bool along_an_axis(const Vec3d& way) {
  return std::max({std::fabs(way.x), std::fabs(way.y), std::fabs(way.z)}) >= kSameDirection;
}

/// Returns the long edges along no axis. A sliver has two; facets of a pipe share the direction of
/// only one.
std::vector<LongEdge> long_edges(const PairLocalPart& view) {
  const std::vector<std::uint32_t>& triangles = view.tree().order();
  const std::size_t count = std::min(triangles.size(), kSampledEdges);
  std::vector<LongEdge> edges;
  for (std::size_t i = 0; i < count; ++i) {
    const Corners c = as_doubles(view.corners(sample(triangles, i, count)));
    const Vec3d normal = normal_of(c);
    const double area = length(normal);
    for (const Vec3d& edge : {c[1] - c[0], c[2] - c[1], c[0] - c[2]}) {
      const double squared = dot(edge, edge);
      if (!(squared > kElongation * area) || !(area > 0)) continue;
      const Vec3d way = edge * (1 / std::sqrt(squared));
      if (!along_an_axis(way)) edges.push_back({way, normal * (1 / area), squared});
    }
  }
  return edges;
}

/// Returns the edge whose direction most others share, of several the longest, if at least so many
/// do.
const LongEdge* most_common(const std::vector<LongEdge>& edges, Vec3d LongEdge::* direction,
                            std::ptrdiff_t least) {
  const LongEdge* best = nullptr;
  std::ptrdiff_t largest = least;
  for (const LongEdge& edge : edges) {
    const auto alike = std::ranges::count_if(edges, [&](const LongEdge& other) {
      return in_one_direction(edge.*direction, other.*direction);
    });
    if (alike < largest || (alike == largest && best != nullptr && edge.squared <= best->squared))
      continue;
    largest = alike;
    best = &edge;
  }
  return best;
}

/// Returns axes along the direction of most long edges, and perpendicular to the plane that most of
/// those lie in.
std::optional<Axes> axes_of(std::vector<LongEdge> edges) {
  const LongEdge* const best = most_common(edges, &LongEdge::way, kMinAlike);
  if (best == nullptr) return std::nullopt;
  const Vec3d z = best->way;
  std::erase_if(edges, [&](const LongEdge& edge) { return !in_one_direction(edge.way, z); });
  const Vec3d y = cross(z, most_common(edges, &LongEdge::normal, 1)->normal);
  const Vec3d unit_y = y * (1 / length(y));
  return Axes{cross(unit_y, z), unit_y, z};
}

}  // namespace

std::optional<Axes> sliver_axes(const PairLocalPart& a, const PairLocalPart& b) {
  auto axes = sliver_axes(a);
  if (!axes) axes = sliver_axes(b);
  return axes;
}

std::optional<Axes> sliver_axes(const PairLocalPart& part) { return axes_of(long_edges(part)); }

std::optional<RotatedParts> rotate_along_slivers(const PairLocalPart& a, const PairLocalPart& b,
                                                 const parallel::Context& context) {
  const auto axes = sliver_axes(a, b);
  if (!axes) return std::nullopt;
  auto of_a = rotate_part(a, *axes, context);
  if (!of_a) return std::nullopt;
  auto of_b = rotate_part(b, *axes, context);
  if (!of_b) return std::nullopt;
  return RotatedParts{std::move(*of_a), std::move(*of_b)};
}

}  // namespace strake::geometry
