// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/union_find.hpp"
#include "geometry/contact_regions/edge_hits.hpp"
#include "geometry/interior_depth/surface_distance/distance_field.hpp"

// Union of near pairs through the interior and through the material of a solid.

namespace strake::geometry {

/// A straight line from one point to another.
struct ParamLine {
  Vec3d from, to;

  [[nodiscard]] Vec3d at(double along) const { return from + (to - from) * along; }
};

/// One of two parts, the near pairs grouped by its triangles, and the other part, a solid.
struct NearSolid {
  const RegionSide& side;
  const PairsByTriangle& own;
  std::span<const NearTrianglePair> pairs;
  const PartWithBvh& other;
  double reach = 0;

  [[nodiscard]] double squared_reach() const { return reach * reach; }
};

/// Unites near pairs between which a line runs inside the other part, a solid. Between consecutive
/// hits a line stays on one side of the surface, so that one point decides each segment, and only
/// where its ends are not united yet.
class InteriorSegments {
 public:
  InteriorSegments(const NearSolid& near, UnionFind& sets, QueryContext& work)
      : near_(near),
        solid_(near.other, Vec3l{} - near.side.other.shift()),
        sets_(sets),
        work_(work) {}

  /// Returns where a line comes within reach, whose square is given, of the other triangles of the
  /// listed pairs, sorted by (along, pair).
  [[nodiscard]] std::vector<EdgeHit> hits_on(const ParamLine& line,
                                             std::span<const std::uint32_t> listed,
                                             double squared) const;

  /// Unites along a line. Returns by how many the number of sets falls.
  std::size_t join(const ParamLine& line, std::span<const EdgeHit> stops);

  /// Returns the pair of an own triangle and the first triangle that a ray from a point of it to
  /// the other triangle of a pair meets.
  [[nodiscard]] std::uint32_t first_at_line(const Vec3d& from, std::uint32_t pair) const;

  [[nodiscard]] bool is_inside(const Vec3d& p) const {
    return solid_.side(on_field_grid(p), work_) == PointSide::inside;
  }

  /// Grid units: up to this distance a line meets a triangle.
  static constexpr double kMeets = 1.0 / 256;

 private:
  NearSolid near_;
  DistanceField solid_;
  UnionFind& sets_;
  QueryContext& work_;
};

/// The sets of near pairs and of the side's vertices: pair i is number i, vertex v number
/// first_vertex + v.
struct InteriorSets {
  UnionFind& sets;
  std::uint32_t first_vertex = 0;
};

/// Unites what the surface of one part connects inside the other, a solid: near pairs between which
/// a segment of an edge, or of a line across a triangle, runs through the interior, and the
/// vertices in there.
void unite_through_interior(const NearSolid& near, const InteriorSets& sets, QueryContext& work);

/// Unites near pairs of one triangle and two spots on the surface of the other part, a solid,
/// between which its material lies within reach of the triangle: the outer and the inner surface of
/// a pipe, the two faces of a plate. Returns by how many the number of sets falls.
std::size_t unite_through_material(const NearSolid& near, UnionFind& sets, QueryContext& work);

}  // namespace strake::geometry
