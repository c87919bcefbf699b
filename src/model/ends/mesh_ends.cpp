// SPDX-License-Identifier: Apache-2.0
#include "model/ends/mesh_ends.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "core/union_find.hpp"
#include "geometry/numeric/vector_math.hpp"

namespace strake::model {
namespace {

using geometry::Part;
using geometry::PartKind;
using geometry::Triangle;
using geometry::Vec3d;

/// The fewest corners of a circle: the side of a faceted body has four.
constexpr std::size_t kFewestCorners = 6;
/// How far a corner may lie off its circle, as a part of the radius, and how long the sides may be:
/// that of a hexagon is as long as the radius.
constexpr double kOffCircle = 0.01, kLongestSide = 1.1;

/// An edge of a face as its triangle runs along it.
struct DirectedEdge {
  std::uint32_t from = 0, to = 0, triangle = 0;
};

/// A closed outline, its edges in order.
using Outline = std::vector<DirectedEdge>;

struct Circle {
  Vec3d centre, normal;  ///< the outline runs counter-clockwise about the normal
  double radius = 0;
};

class MeshEnds {
 public:
  MeshEnds(const Part& part, double off) : part_(part), off_(off) {}

  std::vector<MeshEnd> run() {
    std::vector<MeshEnd> ends;
    if (part_.kind == PartKind::solid)
      for (const auto& edges : rims_of_faces()) add_cap(edges, ends);
    if (part_.kind == PartKind::sheet) add_open_rims(ends);
    return ends;
  }

 private:
  [[nodiscard]] Vec3d corner(std::uint32_t v) const { return part_.vertices[v].as<double>(); }

  [[nodiscard]] Vec3d twice_area(std::uint32_t t) const {
    const Triangle& triangle = part_.triangles[t];
    const Vec3d p = corner(triangle[0]);
    return cross(corner(triangle[1]) - p, corner(triangle[2]) - p);
  }

  /// Whether two triangles that share an edge lie in one plane: in that of the one or of the other,
  /// as a sliver has none to speak of.
  [[nodiscard]] bool in_one_plane(std::uint32_t t, std::uint32_t u,
                                  const geometry::PartEdge& edge) const {
    const Vec3d nt = twice_area(t), nu = twice_area(u);
    if (!(dot(nt, nu) > 0)) return false;
    const auto lies_off = [&](const Vec3d& normal, std::uint32_t other) {
      const std::uint32_t v = geometry::opposite_vertex(part_.triangles[other], edge);
      return std::fabs(dot(normal, corner(v) - corner(edge.v0))) > off_ * length(normal);
    };
    return !lies_off(nt, u) || !lies_off(nu, t);
  }

  [[nodiscard]] UnionFind plane_faces() const {
    UnionFind faces(part_.triangles.size());
    for (std::uint32_t e = 0; e + 1 < part_.edges.size(); ++e) {
      const auto triangles = geometry::incident_triangles(part_, e);
      if (triangles.size() == 2 && in_one_plane(triangles[0], triangles[1], part_.edges[e]))
        faces.join(triangles[0], triangles[1]);
    }
    return faces;
  }

  /// Returns, for each plane face, the edges at which it ends.
  [[nodiscard]] std::vector<std::vector<DirectedEdge>> rims_of_faces() const {
    UnionFind faces = plane_faces();
    std::vector<std::vector<DirectedEdge>> rims(part_.triangles.size());
    for (std::uint32_t t = 0; t < part_.triangles.size(); ++t)
      each_edge(t, [&](const DirectedEdge& edge, std::span<const std::uint32_t> triangles) {
        const bool inner =
            triangles.size() == 2 && faces.root(triangles[0]) == faces.root(triangles[1]);
        if (!inner) rims[faces.root(t)].push_back(edge);
      });
    std::erase_if(rims, [](const auto& edges) { return edges.size() < kFewestCorners; });
    return rims;
  }

  template <class Take>
  void each_edge(std::uint32_t t, Take&& take) const {
    const Triangle& triangle = part_.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const DirectedEdge edge{triangle[k], triangle[(k + 1) % 3], t};
      const std::uint32_t number = geometry::edge_between(part_, edge.from, edge.to);
      take(edge, geometry::incident_triangles(part_, number));
    }
  }

  /// Joins edges to closed outlines, in the order of the edges; those that meet in a corner or do
  /// not close are left out.
  [[nodiscard]] static std::vector<Outline> outlines(const std::vector<DirectedEdge>& edges) {
    std::map<std::uint32_t, const DirectedEdge*> next;
    std::map<std::uint32_t, int> leaving;
    for (const DirectedEdge& edge : edges) {
      next[edge.from] = &edge;
      ++leaving[edge.from];
    }
    std::vector<Outline> all;
    while (!next.empty()) {
      Outline outline;
      std::uint32_t at = next.begin()->first;
      bool simple = true;
      for (auto step = next.find(at); step != next.end(); step = next.find(at)) {
        outline.push_back(*step->second);
        simple = simple && leaving[at] == 1;
        at = step->second->to;
        next.erase(step);
      }
      if (simple && at == outline.front().from) all.push_back(std::move(outline));
    }
    return all;
  }

  /// Returns the circle through three corners well apart, if all corners lie on it.
  [[nodiscard]] std::optional<Circle> circle_of(const Outline& outline) const {
    const std::size_t n = outline.size();
    if (n < kFewestCorners) return std::nullopt;
    const Vec3d p = corner(outline[0].from);
    const Vec3d a = corner(outline[n / 3].from) - p, b = corner(outline[2 * n / 3].from) - p;
    const Vec3d axis = cross(a, b);
    const double square = dot(axis, axis);
    if (!(square > 0)) return std::nullopt;
    const Vec3d to_centre =
        (cross(axis, a) * dot(b, b) + cross(b, axis) * dot(a, a)) * (1 / (2 * square));
    const Circle circle{p + to_centre, unit(axis), length(to_centre)};
    for (const DirectedEdge& edge : outline) {
      const Vec3d spoke = corner(edge.from) - circle.centre;
      if (std::fabs(length(spoke) - circle.radius) > kOffCircle * circle.radius + off_ ||
          std::fabs(dot(spoke, circle.normal)) > 3 * off_ ||
          length(corner(edge.to) - corner(edge.from)) > kLongestSide * circle.radius + off_)
        return std::nullopt;
    }
    return circle;
  }

  void add(const Circle& circle, const Vec3d& outward, std::vector<MeshEnd>& ends) const {
    const Vec3d& c = circle.centre;
    ends.push_back({{std::llround(c.x), std::llround(c.y), std::llround(c.z)}, outward});
  }

  /// Adds a plane face if all its outlines are circles about one centre.
  void add_cap(const std::vector<DirectedEdge>& edges, std::vector<MeshEnd>& ends) const {
    std::vector<Circle> circles;
    std::size_t joined = 0;
    for (const Outline& outline : outlines(edges)) {
      const auto circle = circle_of(outline);
      if (!circle) return;
      circles.push_back(*circle);
      joined += outline.size();
    }
    if (circles.empty() || joined != edges.size()) return;
    const Circle& outer = *std::ranges::max_element(circles, {}, &Circle::radius);
    for (const Circle& circle : circles)
      if (length(circle.centre - outer.centre) > kOffCircle * outer.radius + off_) return;
    add(outer, outer.normal, ends);
  }

  /// Adds the circles in which an open surface ends, outward being away from its triangles there.
  void add_open_rims(std::vector<MeshEnd>& ends) const {
    std::vector<DirectedEdge> edges;
    for (std::uint32_t t = 0; t < part_.triangles.size(); ++t)
      each_edge(t, [&](const DirectedEdge& edge, std::span<const std::uint32_t> triangles) {
        if (triangles.size() == 1) edges.push_back(edge);
      });
    for (const Outline& outline : outlines(edges)) {
      const auto circle = circle_of(outline);
      if (!circle) continue;
      double depth = 0;
      for (const DirectedEdge& edge : outline) {
        const geometry::PartEdge both{std::min(edge.from, edge.to), std::max(edge.from, edge.to)};
        const std::uint32_t v = geometry::opposite_vertex(part_.triangles[edge.triangle], both);
        depth += dot(corner(v) - circle->centre, circle->normal);
      }
      depth /= static_cast<double>(outline.size());
      if (std::fabs(depth) > 3 * off_) add(*circle, circle->normal * (depth < 0 ? 1 : -1), ends);
    }
  }

  const Part& part_;
  double off_;
};

}  // namespace

std::vector<MeshEnd> ends_of(const Part& part, double off) { return MeshEnds(part, off).run(); }

}  // namespace strake::model
