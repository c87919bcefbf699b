// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/depth/depth_field.hpp"
#include "geometry/places/edge_stops.hpp"
#include "strake/core/disjoint_sets.hpp"

namespace strake::geometry {

/// A straight line from one point to another.
struct Line {
  Vec3d from, to;

  [[nodiscard]] Vec3d at(double along) const { return from + (to - from) * along; }
};

/// One of two parts, the near pairs as it sees them, and the other one, a solid.
struct SolidNear {
  const PlacesSide& side;
  const SidePairs& own;
  std::span<const NearTriangles> pairs;
  const TreedPart& other;
  double reach = 0;

  [[nodiscard]] double squared_reach() const { return reach * reach; }
};

/// Joins near pairs between which a line runs inside the other part, a solid. Between two stops
/// that follow each other a line stays on one side of the skin, so that each stretch asks for the
/// side of one point, and only where its ends are not joined yet.
class Stretches {
 public:
  Stretches(const SolidNear& near, DisjointSets& sets, PairWork& work)
      : near_(near),
        solid_(near.other, Vec3l{} - near.side.other.shift()),
        sets_(sets),
        work_(work) {}

  /// Where a line comes within reach, of which the square is given, of the other triangles of those
  /// pairs that are listed: by (along, pair).
  [[nodiscard]] std::vector<EdgeStop> stops_on(const Line& line,
                                               std::span<const std::uint32_t> listed,
                                               double squared) const;

  /// Returns how many sets fewer there are.
  std::size_t join(const Line& line, std::span<const EdgeStop> stops);

  /// The pair of an own triangle and of what a point of it sees first on the way to the other
  /// triangle of a pair.
  [[nodiscard]] std::uint32_t first_seen(const Vec3d& from, std::uint32_t pair) const;

  [[nodiscard]] bool is_inside(const Vec3d& p) const {
    return solid_.side(on_field_grid(p), work_) == PointSide::inside;
  }

  /// How near a line is to what it meets, grid units.
  static constexpr double kMeets = 1.0 / 256;

 private:
  SolidNear near_;
  DepthField solid_;
  DisjointSets& sets_;
  PairWork& work_;
};

}  // namespace strake::geometry
