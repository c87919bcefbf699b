// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_repair/face_holes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "geometry/predicates/exact_normal.hpp"
#include "strake/geometry/part.hpp"

namespace strake::geometry {
namespace {

constexpr std::uint32_t kNoHole = 0xffffffffU;

/// An edge of one triangle.
struct BorderEdge {
  std::uint32_t v0 = 0, v1 = 0;
  std::uint32_t triangle = 0;
};

std::vector<BorderEdge> border_edges(const Part& part) {
  std::vector<BorderEdge> rim;
  for (std::uint32_t e = 0; e + 1 < part.edges.size(); ++e) {
    const std::span<const std::uint32_t> round = incident_triangles(part, e);
    if (round.size() == 1) rim.push_back({part.edges[e].v0, part.edges[e].v1, round[0]});
  }
  return rim;
}

/// The two boundary edges at each vertex; nothing where some vertex has another number of them.
struct EdgeEnds {
  std::uint32_t first = kNoHole, second = kNoHole;
};
std::optional<std::unordered_map<std::uint32_t, EdgeEnds>> ends_of(
    const std::vector<BorderEdge>& rim) {
  std::unordered_map<std::uint32_t, EdgeEnds> at;
  for (std::uint32_t e = 0; e < rim.size(); ++e)
    for (const std::uint32_t v : {rim[e].v0, rim[e].v1}) {
      EdgeEnds& ends = at[v];
      if (ends.first == kNoHole)
        ends.first = e;
      else if (ends.second == kNoHole)
        ends.second = e;
      else
        return std::nullopt;
    }
  const auto has_two = [](const auto& entry) { return entry.second.second != kNoHole; };
  return std::ranges::all_of(at, has_two) ? std::optional(std::move(at)) : std::nullopt;
}

Vec3d rounded_normal(const Part& part, std::uint32_t t) {
  const ExactNormal n = triangle_normal(part, t);
  return {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
}

/// Whether all these vertices lie in the plane of a triangle, up to rounding: each was moved by
/// less than a unit, and the triangle rotated by as much over its height.
bool lie_in_plane(const Part& part, std::uint32_t triangle, std::span<const std::uint32_t> some) {
  constexpr double kOff = 4;
  const ExactNormal n = triangle_normal(part, triangle);
  const Vec3d size = rounded_normal(part, triangle);
  const double largest = (kOff + 2 * part.weld) * std::sqrt(dot(size, size));
  const Vec3l on = part.vertices[part.triangles[triangle][0]].as<std::int64_t>();
  return std::ranges::all_of(some, [&](std::uint32_t v) {
    return std::fabs(static_cast<double>(along(n, part.vertices[v].as<std::int64_t>() - on))) <=
           largest;
  });
}

/// Returns twice the area that a boundary loop surrounds.
double area_within(const Part& part, std::span<const std::uint32_t> rim) {
  const Vec3l from = part.vertices[rim[0]].as<std::int64_t>();
  Vec3d sum{};
  for (std::size_t i = 1; i + 1 < rim.size(); ++i)
    sum = sum + cross((part.vertices[rim[i]].as<std::int64_t>() - from).as<double>(),
                      (part.vertices[rim[i + 1]].as<std::int64_t>() - from).as<double>());
  return std::sqrt(dot(sum, sum));
}

/// Whether at least as much of the part lies in the plane of a triangle as a boundary loop in it
/// surrounds.
bool holds_half(const Part& part, std::uint32_t triangle, std::span<const std::uint32_t> rim) {
  constexpr double kRounded = 0.99;
  double area = 0;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
    if (!lie_in_plane(part, triangle, part.triangles[t])) continue;
    const Vec3d normal = rounded_normal(part, t);
    area += std::sqrt(dot(normal, normal));
  }
  return area >= kRounded * area_within(part, rim);
}

}  // namespace

bool has_incomplete_faces(const Part& part) {
  constexpr std::size_t kMaxCorners = 64, kMaxHoleBoundaries = 16;
  const std::vector<BorderEdge> rim = border_edges(part);
  if (rim.empty()) return false;
  const auto ends = ends_of(rim);
  if (!ends) return false;
  std::vector<std::uint8_t> visited(rim.size(), 0);
  std::vector<std::uint32_t> vertices, triangles;
  std::size_t rims = 0;
  for (std::uint32_t first = 0; first < rim.size(); ++first) {
    if (visited[first] != 0) continue;
    vertices.clear();
    triangles.clear();
    std::uint32_t v = rim[first].v1;
    for (std::uint32_t e = first; visited[e] == 0;) {
      visited[e] = 1;
      vertices.push_back(v);
      triangles.push_back(rim[e].triangle);
      const EdgeEnds& at = ends->at(v);
      e = at.first == e ? at.second : at.first;
      v = rim[e].v0 == v ? rim[e].v1 : rim[e].v0;
    }
    if (vertices.size() > kMaxCorners || ++rims > kMaxHoleBoundaries) return false;
    const auto in_plane = std::ranges::find_if(
        triangles, [&](std::uint32_t t) { return lie_in_plane(part, t, vertices); });
    if (in_plane == triangles.end() || !holds_half(part, *in_plane, vertices)) return false;
  }
  return true;
}

}  // namespace strake::geometry
