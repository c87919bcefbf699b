// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/union_find.hpp"
#include "geometry/contact_regions/edge_hits.hpp"
#include "geometry/interior_depth/surface_distance/distance_field.hpp"

namespace strake::geometry {

/// A straight line from one point to another.
struct ParamLine {
  Vec3d from, to;

  [[nodiscard]] Vec3d at(double along) const { return from + (to - from) * along; }
};

/// One of two parts, the near pairs as it sees them, and the other one, a solid.
struct NearSolid {
  const RegionSide& side;
  const PairsByTriangle& own;
  std::span<const NearTrianglePair> pairs;
  const PartWithBvh& other;
  double reach = 0;

  [[nodiscard]] double squared_reach() const { return reach * reach; }
};

/// Joins near pairs between which a line runs inside the other part, a solid. Between two stops
/// that follow each other a line stays on one side of the skin, so that each stretch asks for the
/// side of one point, and only where its ends are not joined yet.
class InteriorSegments {
 public:
  InteriorSegments(const NearSolid& near, UnionFind& sets, QueryContext& work)
      : near_(near),
        solid_(near.other, Vec3l{} - near.side.other.shift()),
        sets_(sets),
        work_(work) {}

  /// Where a line comes within reach, of which the square is given, of the other triangles of those
  /// pairs that are listed: by (along, pair).
  [[nodiscard]] std::vector<EdgeHit> hits_on(const ParamLine& line,
                                             std::span<const std::uint32_t> listed,
                                             double squared) const;

  /// Returns how many sets fewer there are.
  std::size_t join(const ParamLine& line, std::span<const EdgeHit> stops);

  /// The pair of an own triangle and of what a point of it sees first on the way to the other
  /// triangle of a pair.
  [[nodiscard]] std::uint32_t first_seen(const Vec3d& from, std::uint32_t pair) const;

  [[nodiscard]] bool is_inside(const Vec3d& p) const {
    return solid_.side(on_field_grid(p), work_) == PointSide::inside;
  }

  /// How near a line is to what it meets, grid units.
  static constexpr double kMeets = 1.0 / 256;

 private:
  NearSolid near_;
  DistanceField solid_;
  UnionFind& sets_;
  QueryContext& work_;
};

/// The sets of near pairs, and of the vertices of the side beside them: pair i is number i, vertex
/// v number first_vertex + v.
struct InteriorSets {
  UnionFind& sets;
  std::uint32_t first_vertex = 0;
};

/// Joins what the skin of one part joins inside the other, a solid: near pairs between which a
/// stretch of an edge, or of a line across a triangle, runs through the inside, and the vertices
/// in there.
void unite_through_interior(const NearSolid& near, const InteriorSets& sets, QueryContext& work);

/// Joins near pairs of one triangle of a part and two places on the skin of the other, a solid,
/// between which its material lies within reach of the triangle: the outer and the inner skin of a
/// pipe, the two faces of a plate. Returns how many sets fewer there are.
std::size_t unite_through_material(const NearSolid& near, UnionFind& sets, QueryContext& work);

}  // namespace strake::geometry
