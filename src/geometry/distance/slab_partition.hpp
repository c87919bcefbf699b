// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "geometry/bvh/pair_local_part.hpp"
#include "strake/geometry/part.hpp"
#include "strake/geometry/triangle_bvh.hpp"

namespace strake::geometry {

/// Some of a part's triangles, with a tree of their own.
struct SlabPiece {
  const Part* part = nullptr;
  TriangleBvh tree;

  /// Returns a view in the coordinates of a pair; the triangles keep their numbers.
  [[nodiscard]] PairLocalPart view(const Vec3l& shift) const {
    return {PartWithBvh{{part, {}}, &tree}, shift};
  }
};

/// Two parts partitioned into their flat levels perpendicular to a common direction, a few grid
/// units high and of many triangles each, and one piece with the rest. The boxes of slivers that
/// fan out from one corner nearly all overlap, so that no tree over a whole part separates two flat
/// faces; their heights do.
struct SlabPartition {
  struct Pair {
    const SlabPiece *a = nullptr, *b = nullptr;
    double gap = 0;  ///< distance by their heights; negative where those overlap
  };

  std::vector<SlabPiece> a, b;
  std::vector<Pair> open;  ///< pairs that their heights do not separate, nearest first
  double gap =
      std::numeric_limits<double>::infinity();  ///< all other pairs are at least so far apart
};

struct SlabOptions {
  double apart = 0;                ///< grid units: pairs certainly so far apart count as separated
  std::optional<Vec3d> hint = {};  ///< a direction to try first
  bool whatever_is_left = false;   ///< partition even where that separates next to nothing
};

/// Partitions two parts. Nothing where no direction separates a good share of the triangles; a few
/// samples reject parts without flat faces. O(n log n).
///
/// A direction is the area-weighted mean normal of all triangles that face a rough direction,
/// within a few degrees and the angle error of the snap: a fan has a normal that none of its
/// snapped slivers has.
[[nodiscard]] std::optional<SlabPartition> partition_by_height(const PairLocalPart& a,
                                                               const PairLocalPart& b,
                                                               const SlabOptions& question);

}  // namespace strake::geometry
