// SPDX-License-Identifier: Apache-2.0
#include "hlr/edges/tangent_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "strake/geometry/part.hpp"

namespace strake::hlr {
namespace {

using geometry::Part;
using geometry::PartEdge;
using geometry::Vec3d;
using geometry::Vec3l;

/// Faces as sets of triangles in one plane, and the turns at their smooth edges.
class FlatFaces {
 public:
  FlatFaces(const Part& part, const PlaneOwners& owners, std::span<const FeatureEdge> edges)
      : part_(part), owners_(owners), of_(part.triangles.size()) {
    std::iota(of_.begin(), of_.end(), 0U);
    for (std::uint32_t e = 0; e + 1 < part.edges.size(); ++e) {
      const auto round = geometry::incident_triangles(part, e);
      if (round.size() == 2 && !turns(part.edges[e], round)) unite(round[0], round[1]);
    }
    for (std::uint32_t t = 0; t < of_.size(); ++t) of_[t] = root(t);
    list_members();
    even_.resize(of_.size());
    widest_.resize(of_.size());
    for (std::uint32_t f = 0; f < of_.size(); ++f) {
      if (of_[f] != f) continue;
      even_[f] = is_even(f) ? 1 : 0;
      widest_[f] = width_of_widest(f);
    }
    turns_.resize(of_.size());
    for (const FeatureEdge& edge : edges)
      if (edge.kind == EdgeKind::smooth) note(edge.part_edge);
  }

  [[nodiscard]] bool is_tangent(std::uint32_t edge) const {
    const auto round = geometry::incident_triangles(part_, edge);
    std::uint32_t f = of_[round[0]], g = of_[round[1]];
    if (size(f) > size(g)) std::swap(f, g);
    const double turn = turn_at(edge);
    const double at_f = max_beside(f, turn), at_g = max_beside(g, turn);
    if (at_f < 0 && at_g < 0) return true;
    // No more corners of the larger face are examined than the decision takes.
    const double far = reach(f, edge);
    if (is_wider(g, edge, clearly_wider(far, turn))) return is_like(turn, at_f);
    if (reaches_beyond(g, edge, far / kWider)) return false;
    return is_wider(f, edge, clearly_wider(reach(g, edge), turn)) && is_like(turn, at_g);
  }

 private:
  static constexpr double kWider = 2;
  /// Where one of two facets of a skin is that much wider, the turn is half as much again, which is
  /// more than twice in the measure of turn_at().
  static constexpr double kLike = 1.5;

  /// The grid units by which a flat face may be off its plane.
  static constexpr double kEven = 4;

  /// Returns the width from which on a face is no facet of the skin that a face of this width, with
  /// this turn at its edge, belongs to. Facets that bend by less than rounding are one face, as
  /// wide as the chord that stands so far off the skin.
  static double clearly_wider(double width, double turn) {
    const double radius = width / std::sqrt(2 * turn);
    return std::max(kWider * width, width + 2 * std::sqrt(8 * radius * kEven));
  }

  /// Returns whether a face reaches that far and is flat, or has a triangle that is so wide. A row
  /// of narrow facets, each in one plane with the next but for rounding, is neither.
  [[nodiscard]] bool is_wider(std::uint32_t face, std::uint32_t edge, double than) const {
    return reaches_beyond(face, edge, than) && (even_[face] != 0 || widest_[face] > than);
  }
  /// Returns whether a face is flat. A face of the source counts as flat, however it bends.
  [[nodiscard]] bool is_even(std::uint32_t face) const {
    if (is_of_source(face)) return true;
    Vec3d normal, on;
    for (std::uint32_t m = first_[face]; m < first_[face + 1]; ++m) {
      const Vec3d n = normal_at(members_[m]);
      if (dot(n, n) <= dot(normal, normal)) continue;
      normal = n;
      on = part_.vertices[part_.triangles[members_[m]][0]].as<double>();
    }
    const double largest = kEven * std::sqrt(dot(normal, normal));
    return !any_corner(face, [&](const geometry::Vec3i& p) {
      return std::fabs(dot(normal, p.as<double>() - on)) > largest;
    });
  }
  [[nodiscard]] bool is_of_source(std::uint32_t face) const {
    if (part_.faces.empty() || part_.faces[face] == geometry::kNoIndex) return false;
    return std::all_of(members_.begin() + first_[face], members_.begin() + first_[face + 1],
                       [&](std::uint32_t t) { return part_.faces[t] == part_.faces[face]; });
  }
  /// Returns the width across of the widest triangle of a face.
  [[nodiscard]] double width_of_widest(std::uint32_t face) const {
    double largest = 0;
    for (std::uint32_t m = first_[face]; m < first_[face + 1]; ++m) {
      const geometry::Triangle& t = part_.triangles[members_[m]];
      double longest = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d side =
            part_.vertices[t[(k + 1) % 3]].as<double>() - part_.vertices[t[k]].as<double>();
        longest = std::max(longest, dot(side, side));
      }
      const Vec3d n = normal_at(members_[m]);
      largest = std::max(largest, dot(n, n) / longest);
    }
    return std::sqrt(largest);
  }

  static bool is_like(double turn, double beside) { return beside < 0 || turn <= kLike * beside; }

  /// The largest turns at smooth edges of a face.
  struct Turns {
    double largest = -1, second = -1;
  };

  [[nodiscard]] bool turns(const PartEdge& e, std::span<const std::uint32_t> round) const {
    if (!part_.faces.empty() && part_.faces[round[0]] != geometry::kNoIndex &&
        part_.faces[round[0]] == part_.faces[round[1]])
      return false;
    return bends(part_, owners_, e, round[0], round[1]) ||
           bends(part_, owners_, e, round[1], round[0]);
  }

  [[nodiscard]] std::uint32_t root(std::uint32_t t) {
    for (; of_[t] != t; t = of_[t]) of_[t] = of_[of_[t]];
    return t;
  }
  void unite(std::uint32_t s, std::uint32_t t) {
    s = root(s);
    t = root(t);
    of_[std::max(s, t)] = std::min(s, t);
  }

  [[nodiscard]] std::uint32_t size(std::uint32_t face) const {
    return first_[face + 1] - first_[face];
  }

  void list_members() {
    first_.resize(of_.size() + 1);
    for (const std::uint32_t f : of_) ++first_[f + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    members_.resize(of_.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t t = 0; t < of_.size(); ++t) members_[next[of_[t]]++] = t;
  }

  /// Returns the normal of a triangle, whose length is twice the area.
  [[nodiscard]] Vec3d normal_at(std::uint32_t triangle) const {
    const ExactNormal exact = triangle_normal(part_, triangle);
    return {static_cast<double>(exact[0]), static_cast<double>(exact[1]),
            static_cast<double>(exact[2])};
  }
  /// Returns a measure that grows with the angle: one less the cosine.
  [[nodiscard]] double turn_at(std::uint32_t edge) const {
    const auto round = geometry::incident_triangles(part_, edge);
    std::array<Vec3d, 2> n;
    for (std::size_t k = 0; k < 2; ++k) n[k] = normal_at(owners_.owner(round[k]));
    return 1 - std::fabs(dot(n[0], n[1])) / std::sqrt(dot(n[0], n[0]) * dot(n[1], n[1]));
  }
  void note(std::uint32_t edge) {
    const double turn = turn_at(edge);
    for (const std::uint32_t t : geometry::incident_triangles(part_, edge)) {
      Turns& of_face = turns_[of_[t]];
      of_face.second = std::max(of_face.second, std::min(turn, of_face.largest));
      of_face.largest = std::max(of_face.largest, turn);
    }
  }
  /// Returns the largest turn at a smooth edge of a face other than one with this turn; negative:
  /// none.
  [[nodiscard]] double max_beside(std::uint32_t face, double turn) const {
    const Turns& of_face = turns_[face];
    return of_face.largest > turn ? of_face.largest : of_face.second;
  }

  template <class Visit>
  bool any_corner(std::uint32_t face, Visit&& visit) const {
    for (std::uint32_t m = first_[face]; m < first_[face + 1]; ++m)
      for (const std::uint32_t v : part_.triangles[members_[m]])
        if (visit(part_.vertices[v])) return true;
    return false;
  }
  /// Returns the distance of a point from the line of an edge.
  [[nodiscard]] double distance(const geometry::Vec3i& point, std::uint32_t edge) const {
    const PartEdge& e = part_.edges[edge];
    const Vec3d a = part_.vertices[e.v0].as<double>();
    const Vec3d along = part_.vertices[e.v1].as<double>() - a;
    const Vec3d off = cross(point.as<double>() - a, along);
    return std::sqrt(dot(off, off) / dot(along, along));
  }
  [[nodiscard]] double reach(std::uint32_t face, std::uint32_t edge) const {
    double farthest = 0;
    any_corner(face, [&](const geometry::Vec3i& p) {
      farthest = std::max(farthest, distance(p, edge));
      return false;
    });
    return farthest;
  }
  [[nodiscard]] bool reaches_beyond(std::uint32_t face, std::uint32_t edge, double far) const {
    return any_corner(face, [&](const geometry::Vec3i& p) { return distance(p, edge) > far; });
  }

  const Part& part_;
  const PlaneOwners& owners_;
  std::vector<std::uint32_t> of_;  ///< by triangle: the first triangle of its face
  std::vector<std::uint32_t> first_, members_;
  std::vector<std::uint8_t> even_;  ///< by first triangle, whether the face is flat
  std::vector<double> widest_;      ///< by first triangle
  std::vector<Turns> turns_;        ///< by first triangle
};

}  // namespace

void keep_tangent_edges(const Part& part, const PlaneOwners& owners,
                        std::vector<FeatureEdge>& edges) {
  const auto is_smooth = [](const FeatureEdge& e) { return e.kind == EdgeKind::smooth; };
  if (std::ranges::none_of(edges, is_smooth)) return;
  const FlatFaces faces(part, owners, edges);
  std::erase_if(
      edges, [&](const FeatureEdge& e) { return is_smooth(e) && !faces.is_tangent(e.part_edge); });
}

}  // namespace strake::hlr
