// SPDX-License-Identifier: Apache-2.0
#include "geometry/depth/search_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>

#include "geometry/corners.hpp"
#include "geometry/directions.hpp"

namespace strake::geometry {
namespace {

constexpr std::size_t kMostTriangles = 256;  ///< of a part that is looked at

/// The sine of the angle between directions that count as one, or the cosine of square ones: far
/// more than the snap turns a face by, but for needles.
constexpr double kSquare = 1e-3;

struct Facing {
  Vec3d normal;     ///< unit
  double size = 0;  ///< twice the area
};
Facing facing_of(const Part& part, std::uint32_t triangle) {
  const Vec3d n = normal_of(corners_of(part, triangle));
  const double size = length(n);
  return size > 0 ? Facing{n * (1 / size), size} : Facing{};
}

/// The normal of the largest face of those that a test picks by their normals; none where the part
/// has too many to look at.
template <class Test>
std::optional<Vec3d> largest_facing(const Part& part, const Test& picks) {
  Facing best;
  if (part.triangles.size() <= kMostTriangles)
    for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
      const Facing f = facing_of(part, t);
      // Of equal ones the same, in whatever order they are.
      const auto rank = [](const Facing& x) {
        return std::tuple(x.size, x.normal.x, x.normal.y, x.normal.z);
      };
      if (f.size > 0 && rank(f) > rank(best) && picks(f.normal)) best = f;
    }
  return best.size > 0 ? std::optional(best.normal) : std::nullopt;
}

/// A frame along a triangle's normal and a face square to it.
Axes frame_of_faces(const Part& part, std::uint32_t triangle) {
  const Axes world{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  if (triangle >= part.triangles.size()) return world;
  const Vec3d own = facing_of(part, triangle).normal;
  // Of the faces along the triangle the largest is the truest.
  const auto parallel = [&](const Vec3d& n) { return length(cross(n, own)) < kSquare; };
  const Vec3d z = largest_facing(part, parallel).value_or(own);
  const auto square = [&](const Vec3d& n) { return std::fabs(dot(n, z)) < kSquare; };
  const Vec3d flat =
      largest_facing(part, square).value_or(longest_edge(corners_of(part, triangle)));
  const Vec3d x = flat - z * dot(flat, z);
  const double size = length(x);
  if (!(size > 0) || !(length(z) > 0)) return world;
  const Vec3d unit = x * (1 / size);
  return {unit, cross(z, unit), z};
}

/// Whether faces meet at an edge: not where one face is cut into triangles.
bool is_ridge(const Part& part, std::size_t edge) {
  constexpr double kFlat = 0.9;
  const std::uint32_t first = part.edges[edge].first_triangle;
  if (part.edges[edge + 1].first_triangle != first + 2) return true;
  return dot(facing_of(part, part.edge_triangles[first]).normal,
             facing_of(part, part.edge_triangles[first + 1]).normal) < kFlat;
}

/// What is known of the direction of an axis: the longest edge along it.
struct Along {
  Vec3d edge;
  double squared = 0;  ///< of its length
};

using Alongs = std::array<Along, 3>;

void include_edges(Alongs& longest, const Part& part, const Axes& axes) {
  if (part.triangles.size() > kMostTriangles || part.edges.empty()) return;
  for (std::size_t i = 0; i + 1 < part.edges.size(); ++i) {
    const PartEdge& e = part.edges[i];
    const Vec3d way = (part.vertices[e.v1] - part.vertices[e.v0]).as<double>();
    const double squared = dot(way, way);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d off = cross(axes[k], way);
      if (!(dot(off, off) < kSquare * kSquare * squared)) continue;
      const Vec3d edge = dot(axes[k], way) < 0 ? -way : way;
      // Of equal ones the same, in whatever order they are.
      const auto rank = [](double size, const Vec3d& v) { return std::tuple(size, v.x, v.y, v.z); };
      if (rank(squared, edge) > rank(longest[k].squared, longest[k].edge) && is_ridge(part, i))
        longest[k] = {edge, squared};
    }
  }
}

/// Turns a frame by the little that the snap made it stand off the two longest edges along it.
Axes aligned(const Axes& axes, const Alongs& longest) {
  std::array<std::size_t, 3> by_length{0, 1, 2};
  std::sort(by_length.begin(), by_length.end(), [&](std::size_t i, std::size_t j) {
    return longest[i].squared != longest[j].squared ? longest[i].squared > longest[j].squared
                                                    : i < j;
  });
  const auto [first, second, third] = by_length;
  const auto unit = [](const Vec3d& v) { return v * (1 / length(v)); };
  const auto truest = [&](std::size_t k) {
    return longest[k].squared > 0 ? unit(longest[k].edge) : axes[k];
  };
  Axes turned = axes;
  turned[first] = truest(first);
  const Vec3d other = truest(second);
  turned[second] = unit(other - turned[first] * dot(other, turned[first]));
  const Vec3d square = cross(turned[first], turned[second]);
  turned[third] = dot(square, axes[third]) < 0 ? -square : square;
  return turned;
}

}  // namespace

Axes search_frame(const Part& part, std::uint32_t triangle, const Part& other) {
  const Axes axes = frame_of_faces(part, triangle);
  Alongs longest;
  include_edges(longest, part, axes);
  include_edges(longest, other, axes);
  return aligned(axes, longest);
}

}  // namespace strake::geometry
