// SPDX-License-Identifier: Apache-2.0
#include "model/ends/mesh_ends.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
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
/// How far a corner may lie off its circle, how long a side may be and how long all of them are at
/// least, as parts of the radius: the sides of a hexagon are as long as that. A long narrow facet
/// with corners along its sides lies on a circle as well, but not round it.
constexpr double kOffCircle = 0.01, kLongestSide = 1.1, kMinWayRound = 5.8;
/// Two triangles whose planes differ by less than a degree may be one face: the snap turns narrow
/// ones. Whether the face is plane is decided by all of it.
constexpr double kCosOfOneDegree = 0.9998476951563913;

/// An edge of a face as its triangle runs along it.
struct DirectedEdge {
  std::uint32_t from = 0, to = 0, triangle = 0;
};

/// Triangles that may lie in one plane, and the edges at which they end.
struct Face {
  std::vector<DirectedEdge> rim;
  std::vector<std::uint32_t> triangles;
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
      for (const Face& face : faces()) add_cap(face, ends);
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

  /// Whether two triangles that share an edge may lie in one plane: they are not folded, or the one
  /// lies in the plane of the other, as a sliver has none to speak of.
  [[nodiscard]] bool in_one_plane(std::uint32_t t, std::uint32_t u,
                                  const geometry::PartEdge& edge) const {
    const Vec3d nt = twice_area(t), nu = twice_area(u);
    if (!(dot(nt, nu) > 0)) return false;
    if (dot(nt, nu) >= kCosOfOneDegree * length(nt) * length(nu)) return true;
    const auto lies_in = [&](const Vec3d& normal, std::uint32_t other) {
      const std::uint32_t v = geometry::opposite_vertex(part_.triangles[other], edge);
      return std::fabs(dot(normal, corner(v) - corner(edge.v0))) <= off_ * length(normal);
    };
    return lies_in(nt, u) || lies_in(nu, t);
  }

  [[nodiscard]] UnionFind joined_triangles() const {
    UnionFind joined(part_.triangles.size());
    for (std::uint32_t e = 0; e + 1 < part_.edges.size(); ++e) {
      const auto triangles = geometry::incident_triangles(part_, e);
      if (triangles.size() == 2 && in_one_plane(triangles[0], triangles[1], part_.edges[e]))
        joined.join(triangles[0], triangles[1]);
    }
    return joined;
  }

  /// Returns the faces with enough edges for a circle.
  [[nodiscard]] std::vector<Face> faces() const {
    UnionFind joined = joined_triangles();
    std::vector<Face> faces(part_.triangles.size());
    for (std::uint32_t t = 0; t < part_.triangles.size(); ++t) {
      Face& face = faces[joined.root(t)];
      face.triangles.push_back(t);
      each_edge(t, [&](const DirectedEdge& edge, std::span<const std::uint32_t> triangles) {
        const bool inner =
            triangles.size() == 2 && joined.root(triangles[0]) == joined.root(triangles[1]);
        if (!inner) face.rim.push_back(edge);
      });
    }
    std::erase_if(faces, [](const Face& face) { return face.rim.size() < kFewestCorners; });
    return faces;
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
    double way_round = 0;
    for (const DirectedEdge& edge : outline) {
      const double side = length(corner(edge.to) - corner(edge.from));
      way_round += side;
      const Vec3d spoke = corner(edge.from) - circle.centre;
      if (std::fabs(length(spoke) - circle.radius) > kOffCircle * circle.radius + off_ ||
          std::fabs(dot(spoke, circle.normal)) > 3 * off_ ||
          side > kLongestSide * circle.radius + off_)
        return std::nullopt;
    }
    if (way_round < kMinWayRound * circle.radius) return std::nullopt;
    return circle;
  }

  /// Whether all of a face lies in the plane of a circle.
  [[nodiscard]] bool is_in_plane(const Face& face, const Circle& circle) const {
    return std::ranges::all_of(face.triangles, [&](std::uint32_t t) {
      return std::ranges::all_of(part_.triangles[t], [&](std::uint32_t v) {
        return std::fabs(dot(corner(v) - circle.centre, circle.normal)) <= 3 * off_;
      });
    });
  }

  void add(const Circle& circle, const Vec3d& outward, std::vector<MeshEnd>& ends) const {
    const Vec3d& c = circle.centre;
    const geometry::Vec3l at{std::llround(c.x), std::llround(c.y), std::llround(c.z)};
    ends.push_back({at, outward, reach_behind(part_, at, outward)});
  }

  /// Adds a face if it is plane and all its outlines are circles about one centre.
  void add_cap(const Face& face, std::vector<MeshEnd>& ends) const {
    std::vector<Circle> circles;
    std::size_t joined = 0;
    for (const Outline& outline : outlines(face.rim)) {
      const auto circle = circle_of(outline);
      if (!circle) return;
      circles.push_back(*circle);
      joined += outline.size();
    }
    if (circles.empty() || joined != face.rim.size()) return;
    const Circle& outer = *std::ranges::max_element(circles, {}, &Circle::radius);
    for (const Circle& circle : circles)
      if (length(circle.centre - outer.centre) > kOffCircle * outer.radius + off_) return;
    if (is_in_plane(face, outer)) add(outer, outer.normal, ends);
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

double reach_behind(const Part& part, const geometry::Vec3l& at, const Vec3d& normal) {
  double reach = 0;
  for (const auto& vertex : part.vertices)
    reach = std::max(reach, dot((at - vertex.as<std::int64_t>()).as<double>(), normal));
  return reach;
}

std::vector<MeshEnd> ends_of(const Part& part, double off) { return MeshEnds(part, off).run(); }

}  // namespace strake::model
